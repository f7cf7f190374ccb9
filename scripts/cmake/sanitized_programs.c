// Linked into sanitized programs: what keeps other people's leaks out of our reports.

// In place of the C library's dlclose(): libraries stay loaded. Vulkan drivers keep a few allocations in
// globals of their own. Once the driver is unloaded nothing points to those any more, and the leak
// checker reports them without a name to suppress them by.
__attribute__((visibility("default"))) int dlclose(void* handle) {
    (void)handle;
    return 0;
}

// The validation layer (1.3.239 at least) keeps its state of every submitted command buffer in a cycle of
// shared pointers.
__attribute__((visibility("default"))) const char* __lsan_default_suppressions(void);
const char* __lsan_default_suppressions(void) { return "leak:libVkLayer_khronos_validation\n"; }

// Says nothing when it did.
__attribute__((visibility("default"))) const char* __lsan_default_options(void);
const char* __lsan_default_options(void) { return "print_suppressions=0"; }

// Races are looked for between accesses of our own code. The drivers, layers and libraries that it calls
// are not compiled with the thread sanitizer, which does not see by what they order theirs.
__attribute__((visibility("default"))) const char* __tsan_default_options(void);
const char* __tsan_default_options(void) { return "ignore_noninstrumented_modules=1"; }
