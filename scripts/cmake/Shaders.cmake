# Compiles GLSL to SPIR-V at build time and puts it into a static library, so that the program needs
# no shader files at run time. Expects GLSLANG_VALIDATOR and SPIRV_VAL (Dependencies.cmake).

# hairbench_shaders(<target> HEADER <path> NAMESPACE <name> SHADERS <path>...)
# Adds the static library <target>, which defines <name>::shaderCode() and <name>::shaderPaths() as
# declared in <header>. engine/shaders.h declares those of the program. A path is an entry point,
# relative to the calling folder, with its stage as extension: simulation/wind.comp,
# strands/tessellation.tese. "+word" after it compiles a variant of the file, with HAIRBENCH_WORD
# defined: simulation/rod.comp+packed. Included files are found relative to that folder and to
# shaders/. They need not be listed: the compiler reports them, and a change to one rebuilds all
# files that include it.
function(hairbench_shaders target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;NAMESPACE" "SHADERS")
    set(source_dir "${CMAKE_CURRENT_SOURCE_DIR}")
    set(output_dir "${CMAKE_CURRENT_BINARY_DIR}/${target}")
    file(RELATIVE_PATH shared_dir "${source_dir}" "${PROJECT_SOURCE_DIR}/shaders")
    set(include_dirs -I.)
    if(shared_dir)
        list(APPEND include_dirs "-I${shared_dir}")
    endif()

    set(arrays "")
    set(rows "")
    set(embedded "")
    foreach(shader IN LISTS arg_SHADERS)
        _hairbench_shader("${source_dir}" "${output_dir}" "${shader}" ${include_dirs})
        string(MAKE_C_IDENTIFIER "${shader}" name)
        string(APPEND arrays
            "constexpr std::uint32_t ${name}[] = {\n#include \"${output_dir}/${shader}.inc\"\n};\n")
        string(APPEND rows "    Row{\"${shader}\", ${name}},\n")
        list(APPEND embedded "${output_dir}/${shader}.inc")
    endforeach()

    set(HAIRBENCH_SHADER_HEADER "${arg_HEADER}")
    set(HAIRBENCH_SHADER_NAMESPACE "${arg_NAMESPACE}")
    set(HAIRBENCH_SHADER_ARRAYS "${arrays}")
    set(HAIRBENCH_SHADER_ROWS "${rows}")
    configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/shader_code.cpp.in"
        "${output_dir}/shader_code.cpp" @ONLY)
    # OBJECT_DEPENDS, because the compiler can only find the includes once they exist.
    set_source_files_properties("${output_dir}/shader_code.cpp"
        PROPERTIES OBJECT_DEPENDS "${embedded}")
    add_library(${target} STATIC "${output_dir}/shader_code.cpp")
    # In a unity build, the dependencies of this source would not apply to the including file.
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}")
endfunction()

# Compiles one shader: GLSL -> SPIR-V, validated if spirv-val exists -> a list of words to #include.
# The remaining arguments are -I options of the compiler.
function(_hairbench_shader source_dir output_dir shader)
    string(REPLACE "+" ";" words "${shader}")
    list(POP_FRONT words file)
    list(TRANSFORM words TOUPPER)
    list(TRANSFORM words PREPEND "-DHAIRBENCH_")
    set(spirv "${output_dir}/${shader}.spv")
    set(embed "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedShader.cmake")
    get_filename_component(folder "${spirv}" DIRECTORY)
    file(MAKE_DIRECTORY "${folder}")

    set(validate "")
    if(SPIRV_VAL)
        set(validate COMMAND "${SPIRV_VAL}" --target-env vulkan1.3 --scalar-block-layout "${spirv}")
    endif()
    # -g keeps names and texts for captures, messages and reloading (engine/shaders.h); -gVS would
    # need an extension. Files are named relative to the shader's folder, so that the code does not
    # depend on the project's place, and engine/shaders.h can compile the same code.
    set(absolute "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/AbsoluteDepfile.cmake")
    add_custom_command(
        OUTPUT "${spirv}"
        COMMAND "${GLSLANG_VALIDATOR}" --quiet --target-env vulkan1.3 -g ${words} ${ARGN}
            --depfile "${spirv}.d" -o "${spirv}" "${file}"
        COMMAND "${CMAKE_COMMAND}" "-DDEPFILE=${spirv}.d" "-DOUTPUT=${spirv}"
            "-DFOLDER=${source_dir}" -P "${absolute}"
        ${validate}
        WORKING_DIRECTORY "${source_dir}"
        DEPENDS "${source_dir}/${file}" "${absolute}"
        DEPFILE "${spirv}.d"
        COMMENT "Compiling shader ${shader}"
        VERBATIM)
    add_custom_command(
        OUTPUT "${output_dir}/${shader}.inc"
        COMMAND "${CMAKE_COMMAND}" "-DINPUT=${spirv}" "-DOUTPUT=${output_dir}/${shader}.inc"
            -P "${embed}"
        DEPENDS "${spirv}" "${embed}"
        COMMENT "Embedding shader ${shader}"
        VERBATIM)
endfunction()
