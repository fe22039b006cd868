# Homebrew formula. Not tested: it needs macOS or Linuxbrew. The program itself is written for
# Linux (O_TMPFILE, /proc, EGL, SCHED_FIFO); on macOS only the engine is expected to build.
class Claystack < Formula
  desc "Throw pots on a virtual wheel and export files for 3D printing"
  # No homepage, and the clone that holds this file instead of an archive: there is no release yet.
  head "file://#{File.expand_path("../..", __dir__)}", using: :git, branch: "main"
  license "GPL-3.0-or-later"

  depends_on "cmake" => :build
  depends_on "cli11" => :build
  depends_on "glm" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkg-config" => :build
  depends_on "tl-expected" => :build
  depends_on "boost"
  depends_on "cairo"
  depends_on "cgal"
  depends_on "draco"
  depends_on "fmt"
  depends_on "gmp"
  depends_on "libzip"
  depends_on "meshoptimizer"
  depends_on "mpfr"
  depends_on "open-mesh"
  depends_on "xxhash"
  uses_from_macos "libxml2"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", *std_cmake_args,
           "-DCLAYSTACK_TESTS=OFF", "-DCLAYSTACK_BENCH=OFF", "-DCLAYSTACK_WINDOW=OFF",
           "-DCLAYSTACK_USB=OFF", "-DCLAYSTACK_DRAWINGS=OFF"
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    cp_r pkgshare/"samples", testpath
    system bin/"claystack", "throw", "-q", "samples/bowl.scene.json", "-o", "bowl.pot.json"
    system bin/"claystack", "export", "-q", "bowl.pot.json", "bowl.stl"
    system bin/"claystack", "check", "bowl.stl"
  end
end
