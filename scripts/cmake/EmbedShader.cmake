# cmake -DINPUT=shader.spv -DOUTPUT=shader.inc -P EmbedShader.cmake
# Writes SPIR-V words as the elements of a C++ array, eight per line.
file(READ "${INPUT}" hex HEX)
set(byte "([0-9a-f][0-9a-f])")
string(REGEX REPLACE "${byte}${byte}${byte}${byte}" "0x\\4\\3\\2\\1," words "${hex}")  # little endian
set(word "0x........,")
string(REGEX REPLACE "(${word}${word}${word}${word}${word}${word}${word}${word})" "\\1\n" lines "${words}")
file(WRITE "${OUTPUT}" "${lines}\n")
