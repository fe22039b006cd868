#include "app/render/image_file.hpp"

#include <zlib.h>

#include <cassert>
#include <cstdlib>
#include <new>

namespace {

/// For stb, which frees the result; its own compressor makes pictures two thirds larger.
unsigned char* compressed(const unsigned char* bytes, int size, int* packed_size) {
  auto packed = compressBound(static_cast<uLong>(size));
  auto* const result = static_cast<unsigned char*>(std::malloc(packed));
  if (result == nullptr) return nullptr;
  constexpr int kLevel = 5;  // 6 takes twice the time and saves a twentieth
  const int problem = compress2(result, &packed, bytes, static_cast<uLong>(size), kLevel);
  assert(problem == Z_OK);  // compressBound is large enough
  *packed_size = problem == Z_OK ? static_cast<int>(packed) : 0;
  return result;
}

}  // namespace

// stb is a single header that causes warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS(bytes, size, packed_size, quality) compressed(bytes, size, packed_size)
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace clay::render {

std::string png_of(const Image& image) {
  assert(image.width_px > 0 && image.height_px > 0);
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, image.width_px, image.height_px, 4, image.rgba.data(),
                             4 * image.width_px) == 0)
    throw std::bad_alloc();  // the only cause here: as if the string had thrown it
  return bytes;
}

}  // namespace clay::render
