# Compile options of our own targets. Third-party libraries are left alone.

option(HAIRBENCH_WERROR "Treat warnings in our own code as errors" ON)
set(HAIRBENCH_SANITIZE "" CACHE STRING
    "Sanitizers to build with, as -fsanitize takes them: address,undefined or thread")

# Hidden by default in the whole project. assimp pulls in a library that exports its own tinygltf;
# otherwise the dynamic linker would merge it with ours at program start.
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# Messages name files relative to the source tree, and our programs do not name the machine that
# built them.
if(NOT MSVC)
    set(HAIRBENCH_SHORT_NAMES "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")
endif()

# What GCC and Clang do by themselves. Never tried (docs/install.md).
if(MSVC)
    add_compile_options("$<$<COMPILE_LANGUAGE:C,CXX>:/utf-8;/bigobj>"
        "$<$<COMPILE_LANGUAGE:CXX>:/permissive-;/Zc:__cplusplus;/Zc:preprocessor>")
    add_compile_definitions(NOMINMAX _CRT_SECURE_NO_WARNINGS)
endif()

# Every target of ours calls this. It also applies the requested sanitizers.
function(hairbench_warnings target)
    hairbench_sanitizers(${target})
    if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        return()
    endif()
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi
        # Designated initializers leave members to their defaults on purpose.
        -Wno-missing-field-initializers)
    if(HAIRBENCH_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # These depend on the optimizer and so on the compiler's version. They are worth reading,
        # but not worth failing a build. With sanitizers they are mostly wrong.
        set(keep "-Wno-error=")
        if(HAIRBENCH_SANITIZE)
            set(keep "-Wno-")
        endif()
        foreach(warning IN ITEMS maybe-uninitialized array-bounds stringop-overflow
                stringop-overread free-nonheap-object)
            target_compile_options(${target} PRIVATE ${keep}${warning})
        endforeach()
        # False alarms: std::string in GCC 12 (bug 105651), and since GCC 13 every function that
        # takes a temporary and returns a reference to something else, such as a table row.
        if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
            target_compile_options(${target} PRIVATE -Wno-restrict)
        else()
            target_compile_options(${target} PRIVATE -Wno-dangling-reference)
        endif()
    endif()
endfunction()

# A separate target, because the precompiled headers of programs are C++, not C.
if(HAIRBENCH_SANITIZE)
    add_library(sanitized_programs OBJECT "${CMAKE_CURRENT_LIST_DIR}/sanitized_programs.c")
endif()

# The link option is PUBLIC: a target that links a sanitized library needs the run-time library too.
function(hairbench_sanitizers target)
    if(NOT HAIRBENCH_SANITIZE)
        return()
    endif()
    set(sanitizers -fsanitize=${HAIRBENCH_SANITIZE})
    target_compile_options(${target} PRIVATE
        ${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
    target_link_options(${target} PUBLIC ${sanitizers})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE")
        target_link_libraries(${target} PRIVATE sanitized_programs)
    endif()
endfunction()
