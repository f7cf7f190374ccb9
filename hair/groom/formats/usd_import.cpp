#include "hair/groom/formats/usd_import.h"

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"

extern "C" char** environ;

namespace hair::groom {
namespace {

// ---- Running a program --------------------------------------------------------------------------

[[noreturn]] void failWith(int error, const char* what) {
    throw std::system_error(error, std::generic_category(), what);
}

class File {
public:
    explicit File(int descriptor) : descriptor_(descriptor) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() { close(); }

    int get() const { return descriptor_; }
    void close() {
        if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    }

private:
    int descriptor_;
};

struct Pipe {
    Pipe() : Pipe(open()) {}

    File read;
    File write;

private:
    explicit Pipe(const std::array<int, 2>& ends) : read(ends[0]), write(ends[1]) {}

    // Other children do not get the ends of the pipe.
    static std::array<int, 2> open() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) failWith(errno, "pipe");
        return ends;
    }
};

// A child that is gone in any case.
class Child {
public:
    Child(const std::vector<std::string>& arguments, const File& output, const File& errors) {
        std::vector<char*> pointers;
        for (const std::string& argument : arguments)
            pointers.push_back(const_cast<char*>(argument.c_str()));  // posix_spawn's interface
        pointers.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, output.get(), STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions, errors.get(), STDERR_FILENO);
        const int error =
            posix_spawnp(&id_, pointers.front(), &actions, nullptr, pointers.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0) failWith(error, pointers.front());
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (id_ <= 0) return;
        kill(id_, SIGKILL);
        wait();
    }

    // The child's status, as waitpid has it.
    int wait() {
        int status = 0;
        while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
        }
        id_ = 0;
        return status;
    }

private:
    pid_t id_ = 0;
};

using Take = std::function<void(std::span<const char>)>;
using Poll = std::function<void()>;

constexpr int kPollInterval = 100;  // ms

// Reads both until the child has closed them.
void drain(File& output, const Take& take, File& errors, std::string& text, const Poll& idle) {
    std::vector<char> part(1 << 16);
    while (output.get() >= 0 || errors.get() >= 0) {
        std::array<pollfd, 2> ready{
            pollfd{output.get(), POLLIN, 0}, pollfd{errors.get(), POLLIN, 0}};
        const int count = poll(ready.data(), ready.size(), idle ? kPollInterval : -1);
        if (count == 0 && idle) idle();
        if (count <= 0) continue;
        for (std::size_t i = 0; i < ready.size(); ++i) {
            if (ready[i].revents == 0) continue;
            const ssize_t size = read(ready[i].fd, part.data(), part.size());
            if (size < 0 && errno == EINTR) continue;
            if (size <= 0) {
                (i == 0 ? output : errors).close();
            } else if (i == 0) {
                take(std::span(part).first(static_cast<std::size_t>(size)));
            } else {
                text.append(part.data(), static_cast<std::size_t>(size));
            }
        }
    }
}

std::string lastLine(std::string_view text) {
    while (text.ends_with('\n')) text.remove_suffix(1);
    return std::string(text.substr(text.rfind('\n') + 1));
}

std::string describe(int status) {
    if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
    return "ended with status " + std::to_string(WEXITSTATUS(status));
}

void run(const std::vector<std::string>& arguments, const Take& take, const Poll& idle = {}) {
    Pipe output;
    Pipe errors;
    Child child(arguments, output.write, errors.write);
    output.write.close();
    errors.write.close();
    std::string text;
    drain(output.read, take, errors.read, text, idle);
    const int status = child.wait();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string line = WIFEXITED(status) ? lastLine(text) : "";
    throw engine::Error(line.empty() ? arguments.front() + ' ' + describe(status) : line);
}

// ---- The stream of curves -----------------------------------------------------------------------

struct Section {
    std::uint64_t UsdStreamHeader::* count;
    std::uint64_t size;  // bytes of an element
};

constexpr Section kSections[] = {
    {&UsdStreamHeader::strands, sizeof(std::uint32_t)},
    {&UsdStreamHeader::points, sizeof(glm::vec3)},
    {&UsdStreamHeader::widths, sizeof(float)},
    {&UsdStreamHeader::transparencies, sizeof(float)},
    {&UsdStreamHeader::colors, sizeof(glm::vec3)},
    {&UsdStreamHeader::root_uvs, sizeof(glm::vec2)},
    {&UsdStreamHeader::root_triangles, sizeof(std::array<std::uint32_t, 3>)},
    {&UsdStreamHeader::groups, sizeof(std::int32_t)},
    {&UsdStreamHeader::guides, 1},
    {&UsdStreamHeader::comment, 1},
    {&UsdStreamHeader::warnings, 1},
};

UsdStreamHeader readHeader(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(UsdStreamHeader)) {
        failAt(bytes.size(), "truncated: the header is 104 bytes");
    }
    const auto header = valueAt<UsdStreamHeader>(bytes, 0);
    if (header.magic != UsdStreamHeader::kMagic) failAt(0, "no \"HBCURVES\"");
    if (!std::isfinite(header.metres_per_unit) || header.metres_per_unit <= 0.0) {
        failAt(8, "the unit is " + std::to_string(header.metres_per_unit) + " m");
    }
    std::uint64_t size = sizeof header;
    for (std::size_t i = 0; i < std::size(kSections); ++i) {
        const std::uint64_t count = header.*kSections[i].count;
        // A count is below the size of the file, so that the sum doesn't overflow.
        if (count <= bytes.size()) size += count * kSections[i].size;
        if (count > bytes.size() || size > bytes.size()) {
            failAt(
                16 + 8 * i, "a count of " + std::to_string(count) + " in " +
                                std::to_string(bytes.size()) + " bytes");
        }
    }
    if (size != bytes.size()) failAt(size, "trailing bytes");
    if (header.points > std::numeric_limits<std::uint32_t>::max()) failAt(24, "too many points");
    return header;
}

// Takes sections off in their order.
class Sections {
public:
    Sections(std::span<const std::byte> bytes, const UsdStreamHeader& header)
        : bytes_(bytes), header_(header) {}

    template <class Element>
    std::vector<Element> take() {
        const Section& section = kSections[next_++];
        start_ = end_;
        const std::uint64_t count = header_.*section.count;
        end_ += count * section.size;
        return arrayAt<Element>(bytes_, start_, count);
    }
    // Takes a section of floats, all of them finite.
    template <class Element>
    std::vector<Element> takeFinite(std::string_view name) {
        auto elements = take<Element>();
        requireFinite(elements, start_, name);
        return elements;
    }
    template <class Value>
    PointAttribute<Value> takeAttribute(std::string_view name) {
        const std::uint64_t byte = 16 + 8 * next_;
        auto values = takeFinite<Value>(name);
        if (values.size() == 1) return {.everywhere = values.front(), .values = {}};
        if (!values.empty() && values.size() != header_.points) {
            failAt(byte, "a value for some of the points");
        }
        return {.everywhere = {}, .values = std::move(values)};
    }
    std::string takeText() {
        const auto bytes = take<char>();
        return {bytes.begin(), bytes.end()};
    }
    std::uint64_t start() const { return start_; }  // of what was taken last

private:
    std::span<const std::byte> bytes_;
    const UsdStreamHeader& header_;
    std::size_t next_ = 0;
    std::uint64_t start_ = 0;
    std::uint64_t end_ = sizeof(UsdStreamHeader);
};

std::vector<std::uint32_t> endsOf(std::vector<std::uint32_t> sizes, std::uint64_t points) {
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        end += sizes[i];
        if (sizes[i] == 0 || end > points) {
            failAt(sizeof(UsdStreamHeader) + 4 * i, std::to_string(sizes[i]) + " points");
        }
        sizes[i] = static_cast<std::uint32_t>(end);
    }
    if (end != points) failAt(24, "more points than the strands have");
    return sizes;
}

void requireStrands(
    const std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint64_t strands,
    std::uint64_t offset) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t strand : triangles[i])
            if (strand >= strands) failAt(offset + 12 * i, "strand " + std::to_string(strand));
    }
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

// ---- The tool -----------------------------------------------------------------------------------

constexpr const char* kTool = HAIRBENCH_SOURCE_DIR "/hair/groom/formats/usd_curves.py";
constexpr const char* kInterpreter = HAIRBENCH_SOURCE_DIR "/.deps/python/bin/python";

std::vector<std::byte> readStage(const std::filesystem::path& path) {
    const char* wanted = std::getenv("HAIRBENCH_PYTHON");
    const std::string interpreter = wanted && *wanted ? wanted : kInterpreter;
    try {
        // -B -E: leaves no byte code beside the tool, and nobody's variables change what it does.
        // An absolute path, which is no option whatever it begins with.
        return runTool({interpreter, "-B", "-E", kTool, std::filesystem::absolute(path).string()});
    } catch (const std::system_error& error) {
        throw engine::Error(
            "reading USD needs the project's Python environment: run scripts/setup --python (" +
            std::string(error.what()) + ')');
    }
}

}  // namespace

std::vector<std::byte> runTool(const std::vector<std::string>& arguments) {
    std::vector<std::byte> bytes;
    run(arguments, [&](std::span<const char> part) {
        const auto read = std::as_bytes(part);
        bytes.insert(bytes.end(), read.begin(), read.end());
    });
    return bytes;
}

void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll) {
    std::string rest;
    run(
        arguments,
        [&](std::span<const char> part) {
            rest.append(part.data(), part.size());
            std::size_t begin = 0;
            for (std::size_t end; (end = rest.find('\n', begin)) != std::string::npos;
                 begin = end + 1)
                each_line(std::string_view(rest).substr(begin, end - begin));
            rest.erase(0, begin);
        },
        poll);
    if (!rest.empty()) each_line(rest);
}

StrandSet readUsdStream(std::span<const std::byte> bytes) {
    const UsdStreamHeader header = readHeader(bytes);
    Sections sections(bytes, header);
    StrandSet set;
    set.metres_per_unit = header.metres_per_unit;
    set.ends = endsOf(sections.take<std::uint32_t>(), header.points);
    set.points = sections.takeFinite<glm::vec3>("point");
    set.widths = sections.takeAttribute<float>("width");
    requireNotNegative(set.widths.values, sections.start(), "width");
    if (set.widths.everywhere)
        requireNotNegative({*set.widths.everywhere}, sections.start(), "width");
    set.transparencies = sections.takeAttribute<float>("transparency");
    set.colors = sections.takeAttribute<glm::vec3>("color");
    set.root_uvs = sections.takeFinite<glm::vec2>("root uv");
    if (!set.root_uvs.empty() && set.root_uvs.size() != set.ends.size()) {
        failAt(offsetof(UsdStreamHeader, root_uvs), "root uvs for some of the strands");
    }
    set.root_triangles = sections.take<std::array<std::uint32_t, 3>>();
    requireStrands(set.root_triangles, header.strands, sections.start());
    const auto expectEach = [&](std::size_t count, std::uint64_t byte, const char* what) {
        if (count != 0 && count != set.ends.size())
            failAt(byte, std::string(what) + " for some of the strands");
    };
    set.groups = sections.take<std::int32_t>();
    expectEach(set.groups.size(), offsetof(UsdStreamHeader, groups), "groups");
    set.guides = sections.take<std::uint8_t>();
    expectEach(set.guides.size(), offsetof(UsdStreamHeader, guides), "guides");
    for (std::size_t i = 0; i < set.guides.size(); ++i)
        if (set.guides[i] > 1) failAt(sections.start() + i, "a guide that is neither 0 nor 1");
    set.comment = sections.takeText();
    set.warnings = linesOf(sections.takeText());
    return set;
}

StrandSet importUsd(const StrandFile& file) {
    if (file.path.empty())
        throw engine::Error("USD can be read from a file alone, not from memory");
    const std::vector<std::byte> bytes = readStage(file.path);
    try {
        return readUsdStream(bytes);
    } catch (const engine::Error& error) {
        throw engine::Error(std::string("what usd_curves.py wrote: ") + error.what());
    }
}

}  // namespace hair::groom
