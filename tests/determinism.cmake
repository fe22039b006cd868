# cmake -DSOURCE=... -DWORK=... [-DOPTIMISED=.../replay_pot] -P determinism.cmake: replays the sample
# sessions with two compilers and two optimisation levels; the pots must be identical. OPTIMISED is
# the program of the build under test, if that is an optimised one of GCC: it saves one build.

function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(hashes)
foreach(compiler g++ clang++)
  foreach(level O0 O2)
    set(build ${WORK}/${compiler}-${level})
    set(replay_pot ${build}/samples/replay_pot)
    if(OPTIMISED AND compiler STREQUAL "g++" AND level STREQUAL "O2")
      set(replay_pot ${OPTIMISED})
    else()
      run(${CMAKE_COMMAND} -S ${SOURCE} -B ${build} -G Ninja
        -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-${level}
        -DCLAYSTACK_EXPORT=OFF -DCLAYSTACK_FALCON=OFF -DCLAYSTACK_APP=OFF -DCLAYSTACK_TESTS=OFF)
      run(${CMAKE_COMMAND} --build ${build} --target replay_pot)
    endif()
    set(all "")
    # The strokes of the bowl bend the wall of the vase at its minimum.
    foreach(sample bowl vase bottle cylinder collapse vase,bowl
            paper/bowl paper/vase paper/bottle paper/cylinder paper/collapse)
      string(REGEX REPLACE ",.*" "" scene ${sample})
      string(REGEX REPLACE ".*," "" session ${sample})
      foreach(model "" paper)
        execute_process(
          COMMAND ${replay_pot} ${SOURCE}/samples/${scene}.scene.json
                  ${SOURCE}/samples/${session}.session ${model}
          OUTPUT_VARIABLE pot COMMAND_ERROR_IS_FATAL ANY)
        string(SHA256 hash "${pot}")
        string(APPEND all "${sample} ${model} ${hash}\n")
      endforeach()
    endforeach()
    message(STATUS "${compiler} -${level}\n${all}")
    list(APPEND hashes "${all}")
  endforeach()
endforeach()

list(REMOVE_DUPLICATES hashes)
list(LENGTH hashes different)
if(NOT different EQUAL 1)
  message(FATAL_ERROR "the same sessions gave ${different} different sets of pots")
endif()
