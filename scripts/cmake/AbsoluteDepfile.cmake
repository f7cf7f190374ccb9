# cmake -DDEPFILE=shader.d -DOUTPUT=shader.spv -DFOLDER=shaders -P AbsoluteDepfile.cmake
# Makes the file names in a depfile absolute. They are relative to FOLDER, but CMake would take them
# to be relative to the build.
file(READ "${DEPFILE}" text)
string(REGEX REPLACE "^.*: " "" files "${text}")  # OUTPUT depends on these
string(REGEX REPLACE "[ \n]+" ";" files "${files}")
set(line "${OUTPUT}:")
foreach(file IN LISTS files)
    if(file)
        cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${FOLDER}" NORMALIZE)
        string(REPLACE " " "\\ " file "${file}")
        string(APPEND line " ${file}")
    endif()
endforeach()
string(REPLACE " " "\\ " output "${OUTPUT}")
string(REPLACE "${OUTPUT}:" "${output}:" line "${line}")
file(WRITE "${DEPFILE}" "${line}\n")
