#include "hair/groom/named_files.h"

#include <algorithm>
#include <system_error>

#include "engine/error.h"

namespace hair::groom {
namespace {

namespace fs = std::filesystem;

// Resolves links as far as the path exists.
fs::path placeOf(const fs::path& path) {
    std::error_code error;
    const fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? fs::path() : place;  // circular links: such a file can't be opened
}

}  // namespace

NamedFileCheck ownFolderOnly(const fs::path& file) {
    const fs::path folder = placeOf(file).parent_path();
    return {
        [folder](const fs::path& named) {
            const fs::path place = placeOf(named);
            const auto [end, rest] =
                std::mismatch(folder.begin(), folder.end(), place.begin(), place.end());
            if (end != folder.end())
                throw engine::Error(
                    named.string(), "is outside " + folder.string() +
                                        ", the folder of the file that names it: copy it there");
        },
        {folder}};
}

}  // namespace hair::groom
