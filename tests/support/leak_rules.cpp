// For programs with the address sanitizer: memory that fontconfig and Mesa's drivers keep until the
// process ends is not a leak of the program.

extern "C" {
/// Mesa closes its driver before leaks are counted, and those of a closed library have no name.
int dlclose(void*) { return 0; }
const char* __lsan_default_suppressions();
}

const char* __lsan_default_suppressions() { return "leak:libfontconfig\nleak:_dri.so\n"; }
