// System calls that Emscripten declares but does not have.

#include <fcntl.h>

/// A hint to begin writing to the disk. A page has none.
extern "C" int sync_file_range(int, off_t, off_t, unsigned) { return 0; }
