# Finds every library and tool, and gives each one a single target name, whatever the system calls
# it. Packages come first, so a vcpkg toolchain or a Vulkan SDK works as well as scripts/setup.
# Nothing is downloaded here. docs/dependencies.md says why each one is needed.

set(HAIRBENCH_DEPS "${CMAKE_CURRENT_LIST_DIR}/../../.deps")  # the folder that scripts/setup fills

# hairbench_header_only(<name> <header> [path suffix...]): hairbench::<name>, a system include folder.
function(hairbench_header_only name header)
    string(TOUPPER "${name}_INCLUDE_DIR" variable)
    # PATHS is searched last: a packaged header wins over a fetched one.
    find_path(${variable} ${header}
        HINTS "$ENV{VULKAN_SDK}/include" "$ENV{VULKAN_SDK}/Include"
        PATH_SUFFIXES ${ARGN}
        PATHS "${HAIRBENCH_DEPS}/${name}/include")
    mark_as_advanced(${variable})
    if(NOT ${variable})
        message(FATAL_ERROR
            "${header} (${name}) was not found: run scripts/setup, or set ${variable} to its folder")
    endif()
    add_library(hairbench::${name} INTERFACE IMPORTED GLOBAL)  # IMPORTED: its headers are SYSTEM
    target_include_directories(hairbench::${name} INTERFACE "${${variable}}")
endfunction()

# ---- tools
find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Without these, ccache would not cache files that use a precompiled header.
    set(launcher "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE}")
    set(CMAKE_C_COMPILER_LAUNCHER "${launcher}")
    set(CMAKE_CXX_COMPILER_LAUNCHER "${launcher}")
    add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
endif()
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang
    HINTS "$ENV{VULKAN_SDK}/bin" "$ENV{VULKAN_SDK}/Bin" REQUIRED)
find_program(SPIRV_VAL spirv-val HINTS "$ENV{VULKAN_SDK}/bin" "$ENV{VULKAN_SDK}/Bin")
mark_as_advanced(CCACHE GLSLANG_VALIDATOR SPIRV_VAL)

# ---- Vulkan
find_package(VulkanHeaders CONFIG QUIET)
if(NOT TARGET Vulkan::Headers)
    find_package(Vulkan REQUIRED)
endif()

# volk is compiled here. Debian 12 packages only its sources, and a packaged library may have been
# built for headers other than ours.
find_file(VOLK_SOURCE volk.c
    HINTS "$ENV{VULKAN_SDK}/include" "$ENV{VULKAN_SDK}/Include"
    PATH_SUFFIXES volk Volk)
mark_as_advanced(VOLK_SOURCE)
if(VOLK_SOURCE)
    get_filename_component(VOLK_INCLUDE_DIR "${VOLK_SOURCE}" DIRECTORY)
    add_library(hairbench_volk STATIC "${VOLK_SOURCE}")
    set_target_properties(hairbench_volk PROPERTIES C_VISIBILITY_PRESET hidden)
    target_include_directories(hairbench_volk SYSTEM PUBLIC "${VOLK_INCLUDE_DIR}")
    target_compile_definitions(hairbench_volk PUBLIC VK_NO_PROTOTYPES)
    target_link_libraries(hairbench_volk PUBLIC Vulkan::Headers ${CMAKE_DL_LIBS})
    add_library(hairbench::volk ALIAS hairbench_volk)
else()
    find_package(volk CONFIG REQUIRED)
    add_library(hairbench::volk INTERFACE IMPORTED GLOBAL)
    target_compile_definitions(hairbench::volk INTERFACE VK_NO_PROTOTYPES)
    target_link_libraries(hairbench::volk INTERFACE volk::volk)
endif()

hairbench_header_only(vma vk_mem_alloc.h vma)
target_link_libraries(hairbench::vma INTERFACE Vulkan::Headers)

# ---- the viewer
find_package(glfw3 CONFIG REQUIRED)
# Dear ImGui is compiled here, from source. The Vulkan back end of a packaged library is linked with
# the loader's functions, and crashes with volk's in their place.
find_path(IMGUI_DIR imgui.h PATHS "${HAIRBENCH_DEPS}/imgui" NO_DEFAULT_PATH)
mark_as_advanced(IMGUI_DIR)
if(NOT IMGUI_DIR)
    message(FATAL_ERROR
        "Dear ImGui was not found: run scripts/setup, or set IMGUI_DIR to a folder of its sources")
endif()
add_library(hairbench_imgui STATIC
    ${IMGUI_DIR}/imgui.cpp
    ${IMGUI_DIR}/imgui_draw.cpp
    ${IMGUI_DIR}/imgui_tables.cpp
    ${IMGUI_DIR}/imgui_widgets.cpp
    ${IMGUI_DIR}/backends/imgui_impl_glfw.cpp
    ${IMGUI_DIR}/backends/imgui_impl_vulkan.cpp)
target_include_directories(hairbench_imgui SYSTEM PUBLIC ${IMGUI_DIR})
target_compile_definitions(hairbench_imgui PRIVATE IMGUI_IMPL_VULKAN_NO_PROTOTYPES VK_NO_PROTOTYPES)
# With this, Dear ImGui reports its widgets to engine/ui.cpp on request.
target_compile_definitions(hairbench_imgui PUBLIC IMGUI_ENABLE_TEST_ENGINE)
target_compile_options(hairbench_imgui PRIVATE -w)
target_link_libraries(hairbench_imgui PUBLIC glfw Vulkan::Headers)
add_library(hairbench::imgui ALIAS hairbench_imgui)
find_file(HAIRBENCH_UI_FONT DejaVuSans.ttf
    PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/TTF /usr/share/fonts/dejavu)
mark_as_advanced(HAIRBENCH_UI_FONT)

# glslang as a library, to compile shaders while the viewer runs. Its package names SPIRV-Tools'
# libraries as if they had been found; later releases have fewer libraries of their own.
find_package(SPIRV-Tools-opt CONFIG QUIET)
find_package(SPIRV-Tools-link CONFIG QUIET)
find_package(glslang CONFIG REQUIRED)
add_library(hairbench::glslang INTERFACE IMPORTED GLOBAL)
foreach(part SPIRV glslang glslang-default-resource-limits)
    if(TARGET glslang::${part})
        target_link_libraries(hairbench::glslang INTERFACE glslang::${part})
    endif()
endforeach()

# ---- everything else
find_package(glm CONFIG REQUIRED)
find_package(assimp CONFIG REQUIRED)
find_package(draco CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(OpenEXR CONFIG REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)

# What engine/system links.
add_library(hairbench::system INTERFACE IMPORTED GLOBAL)
if(WIN32)
    target_link_libraries(hairbench::system INTERFACE psapi)
else()
    # libseccomp is linked statically if that is packaged: it is small, and makes one library fewer
    # to ship.
    find_path(SECCOMP_INCLUDE_DIR seccomp.h)
    find_library(SECCOMP_LIBRARY NAMES libseccomp.a seccomp)
    mark_as_advanced(SECCOMP_INCLUDE_DIR SECCOMP_LIBRARY)
    if(NOT SECCOMP_INCLUDE_DIR OR NOT SECCOMP_LIBRARY)
        message(FATAL_ERROR "libseccomp was not found: run scripts/setup, or set "
            "SECCOMP_INCLUDE_DIR and SECCOMP_LIBRARY")
    endif()
    target_include_directories(hairbench::system INTERFACE "${SECCOMP_INCLUDE_DIR}")
    target_link_libraries(hairbench::system INTERFACE "${SECCOMP_LIBRARY}" ${CMAKE_DL_LIBS})
endif()

# Debian 12's and Ubuntu 24.04's packages have no CMake files.
find_package(re2 CONFIG QUIET)
add_library(hairbench::re2 INTERFACE IMPORTED GLOBAL)
if(TARGET re2::re2)
    target_link_libraries(hairbench::re2 INTERFACE re2::re2)
else()
    find_path(RE2_INCLUDE_DIR re2/re2.h)
    find_library(RE2_LIBRARY re2)
    mark_as_advanced(RE2_INCLUDE_DIR RE2_LIBRARY)
    if(NOT RE2_INCLUDE_DIR OR NOT RE2_LIBRARY)
        message(FATAL_ERROR
            "RE2 was not found: run scripts/setup, or set RE2_INCLUDE_DIR and RE2_LIBRARY")
    endif()
    target_include_directories(hairbench::re2 INTERFACE "${RE2_INCLUDE_DIR}")
    target_link_libraries(hairbench::re2 INTERFACE "${RE2_LIBRARY}")
endif()
hairbench_header_only(tinygltf tiny_gltf.h)
hairbench_header_only(stb stb_image_write.h stb)
hairbench_header_only(valijson valijson/validator.hpp)

# ---- tests only
if(BUILD_TESTING OR NOT DEFINED BUILD_TESTING)
    find_package(GTest CONFIG REQUIRED)
    # SwiftShader comes with Chromium. Its own ICD file has a path that only Chromium understands,
    # so tests make the loader read this one (VK_DRIVER_FILES).
    find_library(HAIRBENCH_SWIFTSHADER vk_swiftshader NO_DEFAULT_PATH
        PATHS /usr/lib/chromium /usr/lib/chromium-browser /usr/lib64/chromium-browser
            /opt/google/chrome)
    mark_as_advanced(HAIRBENCH_SWIFTSHADER)
    set(HAIRBENCH_SWIFTSHADER_ICD "${PROJECT_BINARY_DIR}/swiftshader_icd.json")
    if(HAIRBENCH_SWIFTSHADER)
        file(CONFIGURE OUTPUT "${HAIRBENCH_SWIFTSHADER_ICD}" CONTENT [[
{"file_format_version": "1.0.0",
 "ICD": {"library_path": "@HAIRBENCH_SWIFTSHADER@", "api_version": "1.3.0"}}
]] @ONLY)
    else()
        file(REMOVE "${HAIRBENCH_SWIFTSHADER_ICD}")
    endif()
endif()
