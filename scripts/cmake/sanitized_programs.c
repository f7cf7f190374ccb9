// Linked into sanitized programs, to keep leaks of third-party code out of our reports.

// Replaces the C library's dlclose(), so that libraries stay loaded. Vulkan drivers keep a few
// allocations in globals. After a driver is unloaded nothing points to them, and the leak checker
// reports them without a name to suppress them by.
__attribute__((visibility("default"))) int dlclose(void* handle) {
    (void)handle;
    return 0;
}

// The validation layer (1.3.239 at least) keeps its state of every submitted command buffer in a
// cycle of shared pointers.
__attribute__((visibility("default"))) const char* __lsan_default_suppressions(void);
const char* __lsan_default_suppressions(void) { return "leak:libVkLayer_khronos_validation\n"; }

// Does not report suppressed leaks.
__attribute__((visibility("default"))) const char* __lsan_default_options(void);
const char* __lsan_default_options(void) { return "print_suppressions=0"; }

// Checks only accesses of our own code for races. Drivers, layers and libraries are not compiled
// with the thread sanitizer, so it can't see how they order their accesses.
__attribute__((visibility("default"))) const char* __tsan_default_options(void);
const char* __tsan_default_options(void) { return "ignore_noninstrumented_modules=1"; }
