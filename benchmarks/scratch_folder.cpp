#include "benchmarks/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "engine/error.h"

namespace benchmarks {

ScratchFolder::ScratchFolder() {
    std::string path = (std::filesystem::temp_directory_path() / "hairbench-XXXXXX").string();
    if (!mkdtemp(path.data())) throw engine::Error(path, "can't be made");
    path_ = path;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace benchmarks
