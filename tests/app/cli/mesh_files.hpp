#pragma once
#include "claystack/export/formats.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::test {

/// Tests of commands that read meshes from a folder.
class MeshFiles : public testing::Test {
 protected:
  /// The name of a binary STL with this mesh.
  [[nodiscard]] std::string write(const std::string& name, const solid::TriangleMesh& mesh) const {
    write_text(folder.file(name), solid::encode_stl_binary(mesh));
    return folder.file(name);
  }
  ScratchFolder folder;
};

}  // namespace clay::test
