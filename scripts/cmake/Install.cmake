# `cmake --install` and `cpack`. An installed tree can be moved, because programs find their files
# relative to themselves (engine/files.h). So these folders have no variables.

# Windows' archive has the program at its top, to be run where it is unpacked.
if(WIN32)
    install(TARGETS hairbench RUNTIME DESTINATION .)
else()
    install(TARGETS hairbench RUNTIME DESTINATION bin)
endif()
install(TARGETS hairbench_mesh_reader hairbench_pipeline_trial RUNTIME DESTINATION libexec/hairbench)
# Users make the Python environments themselves, from pinned requirements.
if(NOT WIN32)
    install(PROGRAMS scripts/python-environment DESTINATION libexec/hairbench)
endif()
install(FILES scripts/requirements.txt scripts/requirements-module.txt
    scripts/requirements-reference.txt
    DESTINATION libexec/hairbench)

# Files that are read at run time are named as in the source tree.
install(DIRECTORY scenes DESTINATION share/hairbench PATTERN "make_*.py" EXCLUDE)
install(DIRECTORY shaders DESTINATION share/hairbench PATTERN "CMakeLists.txt" EXCLUDE)
install(DIRECTORY benchmarks/report/page DESTINATION share/hairbench/benchmarks/report)
# Report pages need this library. If scripts/setup could not fetch it, everything else still works.
install(FILES .deps/plotly/plotly.min.js.gz
    DESTINATION share/hairbench/benchmarks/report/page OPTIONAL)
install(FILES .deps/plotly/LICENSE
    DESTINATION share/doc/hairbench RENAME copyright-plotly.js OPTIONAL)
install(DIRECTORY benchmarks/reference DESTINATION share/hairbench/benchmarks
    FILES_MATCHING PATTERN "*.py")
install(DIRECTORY hair/groom/formats DESTINATION share/hairbench/hair/groom
    FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)

# The wheel has the module where Python finds it.
if(NOT SKBUILD)
    install(DIRECTORY benchmarks/python/hairbench DESTINATION share/hairbench/python
        PATTERN "__pycache__" EXCLUDE)
endif()

if(TARGET help_files)
    set(help_dir "${PROJECT_BINARY_DIR}/help")  # benchmarks/CMakeLists.txt
    install(FILES "${help_dir}/hairbench" DESTINATION share/bash-completion/completions)
    # zsh searches the first folder under /usr/local; Debian's searches the second under /usr.
    foreach(folder site-functions vendor-completions)
        install(FILES "${help_dir}/_hairbench" DESTINATION share/zsh/${folder})
    endforeach()
    install(FILES "${help_dir}/hairbench.fish" DESTINATION share/fish/vendor_completions.d)
    install(DIRECTORY "${help_dir}/man1" DESTINATION share/man)
endif()
install(FILES README.md DESTINATION share/doc/hairbench)
install(FILES LICENSE DESTINATION share/doc/hairbench RENAME copyright)
install(DIRECTORY docs DESTINATION share/doc/hairbench)
# The schemas of reports, to read and for `doctor --reports`.
install(DIRECTORY results DESTINATION share/hairbench
    FILES_MATCHING PATTERN "*.schema.json" PATTERN "pictures" EXCLUDE PATTERN "local" EXCLUDE)
install(DIRECTORY results DESTINATION share/doc/hairbench
    FILES_MATCHING PATTERN "README.md" PATTERN "*.schema.json"
    PATTERN "pictures" EXCLUDE PATTERN "local" EXCLUDE)

# ---- The package

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hairbench)
set(CPACK_PACKAGE_VENDOR "hairbench contributors")
set(CPACK_PACKAGE_CONTACT "hairbench contributors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Vulkan benchmark and research harness for human hair")
set(CPACK_PACKAGE_DESCRIPTION
    "Simulates guide hairs in compute shaders, draws strands made from them, times every pass on
the GPU and says how far the figures can be trusted. Without a GPU it runs on lavapipe, the
software device of mesa-vulkan-drivers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time, so dpkg-shlibdeps does not see it.
set(CPACK_DEBIAN_PACKAGE_DEPENDS libvulkan1)
# A device for machines without a GPU, the viewer's font, and a tool to make Python environments.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers, fonts-dejavu-core, python3-venv")
include(CPack)
