#include "hair/groom/named_files.h"

#include <algorithm>
#include <system_error>

#include "engine/error.h"

namespace hair::groom {

namespace fs = std::filesystem;

fs::path placeOf(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    const fs::path place = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : place;  // circular links: such a file cannot be
                                                         // opened
}

bool isBelow(const fs::path& file, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
           folder.end();
}

NamedFileCheck ownFolderOnly(const fs::path& file) {
    const fs::path folder = placeOf(file).parent_path();
    return {
        [folder](const fs::path& named) {
            if (!isBelow(placeOf(named), folder))
                throw engine::Error(
                    named.string(), "is outside " + folder.string() +
                                        ", the folder of the file that names it: copy it there");
        },
        {folder}};
}

}  // namespace hair::groom
