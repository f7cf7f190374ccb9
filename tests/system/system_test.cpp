#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>

#include <gmock/gmock.h>

#include "engine/system/child.h"
#include "engine/system/files.h"
#include "engine/system/machine.h"
#include "engine/system/process.h"
#include "tests/temporary_folder.h"
#include "tests/variable.h"

// Tests the promises of engine/system's headers, which hold on every system. This program is also
// its own child: main() is at the end.
namespace engine::system {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const bool kIsWindows = kProgramEnding == ".exe";

// Names in letters that one byte can't hold, as users' folders have them.
const std::string kName = "größe 日本 😀";

// Wine has this library. It says so itself, because it does not do all that Windows does.
bool isWine() {
    return kIsWindows && Library("ntdll.dll").find<void (*)()>("wine_get_version") != nullptr;
}

// ---- The child ----------------------------------------------------------------------------------

std::vector<std::string> childCommand(const std::vector<std::string>& words) {
    std::vector<std::string> command{thisProgram().string(), "child"};
    command.insert(command.end(), words.begin(), words.end());
    return command;
}

struct Ran {
    ChildEnd end;
    std::string output;
    std::string errors;
};

Ran runSelf(const std::vector<std::string>& words, const ChildLimits& limits = {}) {
    Ran ran;
    ran.end = runChild(
        childCommand(words), limits,
        [&](std::span<const char> part) { ran.output.append(part.data(), part.size()); }, {},
        ran.errors);
    return ran;
}

[[noreturn]] void sleepForEver() {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

void say(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

constexpr std::size_t kMuch = std::size_t{1} << 20;  // bytes

int beChild(const std::vector<std::string>& words) {
    const std::string& wanted = words.at(0);
    if (wanted == "arguments") {
        for (std::size_t i = 1; i < words.size(); ++i) say(words[i] + '\0');
        return 7;
    }
    if (wanted == "much") {
        for (std::size_t written = 0; written < kMuch; written += 1024) {
            say(std::string(1024, 'o'));
            std::fwrite(std::string(1024, 'e').data(), 1, 1024, stderr);
        }
        std::fputs("the last words", stderr);
        return 0;
    }
    if (wanted == "write for ever")
        for (;;) say(std::string(1024, 'o'));
    if (wanted == "compute for ever")
        for (std::chrono::steady_clock::time_point now;;) now = std::chrono::steady_clock::now();
    if (wanted == "memory") {
        try {
            std::vector<char> memory(std::stoull(words.at(1)), 'm');
            say(std::string(1, memory.back()));
            std::this_thread::sleep_for(std::chrono::seconds(2));  // until somebody looks
        } catch (const std::bad_alloc&) {
            return 3;
        }
        return 0;
    }
    if (wanted == "variable") {
        const char* const value = std::getenv(words.at(1).c_str());
        say(value ? value : "none");
        return 0;
    }
    if (wanted == "temporary") {
        say(fs::temp_directory_path().generic_string());
        return 0;
    }
    if (wanted == "start another") {
        try {
            say(runSelf({"arguments", "started"}).output.starts_with("started") ? "yes" : "no");
        } catch (const std::system_error&) {
            say("no");
        }
        return 0;
    }
    if (wanted == "print") {
        say(textOf(words.at(1)));
        return 0;
    }
    if (wanted == "terminal") {
        say(hasTerminal() ? "yes" : "no");
        return 0;
    }
    if (wanted == "end now") {
        std::fputs("never written", stdout);  // into the buffer
        endNow(9);
    }
    if (wanted == "interrupted") {
        watchInterrupts([] {}, [] { endNow(5); });
        say("ready");
        sleepForEver();
    }
    if (wanted == "hold") {
        const Locked locked = openLocked(words.at(1));
        say(locked.lock == Lock::held ? "held" : "not held");
        sleepForEver();
    }
    if (wanted == "let another hold") {
        const fs::path path = words.at(1);
        const Program another(
            childCommand({"hold", words.at(1)}), path.parent_path() / "another.txt",
            path.parent_path());
        sleepForEver();
    }
    throw std::invalid_argument(wanted);
}

template <class Condition>
bool waitFor(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

TEST(Child, GetsItsArgumentsAsTheyAre) {
    const std::vector<std::string> arguments{
        "",          "a b", "a\"b", "\"",           "a\\b",  "a b\\",     "a\\\\\"b", "\\\\",
        "tab\there", "*",   kName,  "%PATH% $HOME", "'one'", "a&b|c>d^e", "--x=1"};
    std::vector<std::string> words{"arguments"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::string expected;
    for (const std::string& each : arguments) expected += each + '\0';
    const Ran ran = runSelf(words);
    EXPECT_EQ(ran.output, expected);
    EXPECT_EQ(ran.end.status, 7);
    EXPECT_FALSE(ran.end.signaled || ran.end.out_of_time || ran.end.out_of_memory);
}

TEST(Child, ThatIsNotThereIsAnError) {
    std::string errors;
    try {
        runChild({(fs::path("no such folder") / "program").string()}, {}, {}, {}, errors);
        ADD_FAILURE() << "something ran";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory) << error.what();
    }
}

TEST(Child, IsReadOnBothStreams) {
    const Ran ran = runSelf({"much"});
    EXPECT_EQ(ran.output, std::string(kMuch, 'o'));
    EXPECT_TRUE(ran.errors.ends_with("eeethe last words"));
    EXPECT_GE(ran.errors.size(), std::size_t{1} << 16);
    EXPECT_LT(ran.errors.size(), kMuch);
}

TEST(Child, EndsWithItsCpuTime) {
    if (isWine()) GTEST_SKIP() << "Wine tells a process only its own CPU time";
    const Ran ran = runSelf({"compute for ever"}, {.seconds = 1});
    EXPECT_TRUE(ran.end.out_of_time);
    EXPECT_TRUE(ran.end.signaled || ran.end.status != 0);
}

TEST(Child, GetsNoMoreMemoryThanItsLimit) {
    constexpr std::size_t kLimit = std::size_t{512} << 20;
    const Ran small = runSelf({"memory", std::to_string(kLimit / 8)}, {.bytes = kLimit});
    EXPECT_EQ(small.output, "m");
    EXPECT_EQ(small.end.status, 0);
    const Ran large = runSelf({"memory", std::to_string(2 * kLimit)}, {.bytes = kLimit});
    EXPECT_TRUE(large.end.signaled || large.end.status != 0);
}

TEST(Child, WithLimitsOnReadingGetsOnlyListedVariables) {
    setVariable("HAIRBENCH_SECRET", kName);
    EXPECT_EQ(runSelf({"variable", "HAIRBENCH_SECRET"}).output, kName);
    const ChildLimits limits{.reads = std::vector{thisProgram()}};
    EXPECT_EQ(runSelf({"variable", "HAIRBENCH_SECRET"}, limits).output, "none");
    EXPECT_NE(runSelf({"variable", "PATH"}, limits).output, "none");
}

TEST(Child, WithLimitsOnReadingStartsNoOther) {
    EXPECT_EQ(runSelf({"start another"}).output, "yes");
    if (isWine()) GTEST_SKIP() << "Wine does not count the processes of a job";
    const Ran ran = runSelf({"start another"}, {.reads = std::vector{thisProgram()}});
    EXPECT_NE(ran.output, "yes");
}

TEST(Child, EndsWhenItsReaderThrows) {
    const auto take = [](std::span<const char>) { throw std::runtime_error("enough"); };
    std::string errors;
    EXPECT_THROW(
        runChild(childCommand({"write for ever"}), {}, take, {}, errors), std::runtime_error);
    const auto poll = [] { throw std::runtime_error("enough"); };
    EXPECT_THROW(
        runChild(
            childCommand({"compute for ever"}), {}, [](auto) {}, poll, errors),
        std::runtime_error);
}

TEST(Child, HasNoTerminal) { EXPECT_EQ(runSelf({"terminal"}).output, "no"); }

TEST(Child, ThatEndsNowWritesNoMore) {
    const Ran ran = runSelf({"end now"});
    EXPECT_EQ(ran.end.status, 9);
    EXPECT_EQ(ran.output, "");
}

TEST(Child, ReadsASharedFileByItsName) {
    const SharedFile file(kName);
    EXPECT_EQ(runSelf({"print", file.name()}).output, kName);
}

// ---- Programs -----------------------------------------------------------------------------------

TEST(Program, WritesToAFileAndHasItsOwnTemporaryFolder) {
    const TemporaryFolder folder;
    const fs::path output = folder.file(kName + ".txt"), temporary = folder.file("temporary");
    fs::create_directory(temporary);
    Program program(childCommand({"temporary"}), output, temporary);
    std::optional<ChildEnd> end;
    ASSERT_TRUE(waitFor([&] { return (end = program.end()).has_value(); }));
    EXPECT_EQ(end->status, 0);
    std::string said = textOf(output);
    if (said.ends_with('/')) said.pop_back();
    EXPECT_EQ(said, temporary.generic_string());
}

TEST(Program, ThatIsNotThereEndsWith127) {
    const TemporaryFolder folder;
    Program program({folder.file("none").string()}, folder.file("out.txt"), folder.path());
    std::optional<ChildEnd> end;
    ASSERT_TRUE(waitFor([&] { return (end = program.end()).has_value(); }));
    EXPECT_EQ(end->status, 127);
}

TEST(Program, IsInterrupted) {
    if (isWine()) GTEST_SKIP() << "Wine gives a program that a shell started no console";
    const TemporaryFolder folder;
    Program program(childCommand({"interrupted"}), folder.file("out.txt"), folder.path());
    ASSERT_TRUE(waitFor([&] { return textOf(folder.file("out.txt")) == "ready"; }));
    EXPECT_FALSE(program.end());
    program.interrupt();
    std::optional<ChildEnd> end;
    ASSERT_TRUE(waitFor([&] { return (end = program.end()).has_value(); }));
    EXPECT_EQ(end->status, 5);
}

TEST(Program, EndsWithThoseThatItStarted) {
    const TemporaryFolder folder;
    const fs::path path = folder.file("locked.txt");
    {
        const Program program(
            childCommand({"let another hold", path.string()}), folder.file("out.txt"),
            folder.path());
        ASSERT_TRUE(waitFor([&] { return textOf(folder.file("another.txt")) == "held"; }));
        EXPECT_EQ(openLocked(path).lock, Lock::by_another);
    }
    EXPECT_TRUE(waitFor([&] { return openLocked(path).lock == Lock::held; }));
}

// ---- Files --------------------------------------------------------------------------------------

// A folder whose path is longer than the 260 characters that Windows once allowed.
class Files : public testing::Test {
protected:
    Files() {
        path_ = folder_.path();
        while (path_.native().size() < 300) path_ /= kName + std::string(40, 'x');
        fs::create_directories(path_);
    }
    // MinGW-w64's remove_all() knows only short paths.
    ~Files() override {
        std::error_code ignored;
        for (int i = 0; path_ != folder_.path(); ++i) {
            const fs::path parent = path_.parent_path();
            fs::rename(path_, folder_.file(std::to_string(i)), ignored);
            path_ = parent;
        }
    }

    fs::path file(const std::string& name) const { return path_ / name; }
    fs::path write(const std::string& name, std::string_view text) const {
        Opened opened = createFile(file(name));
        EXPECT_EQ(opened.error, 0);
        EXPECT_EQ(opened.file.write(text), 0);
        EXPECT_EQ(opened.file.close(), 0);
        return file(name);
    }

    TemporaryFolder folder_;
    fs::path path_;
};

TEST_F(Files, AreCreatedButNeverTwice) {
    const fs::path path = write(kName, "first\n");
    const Opened again = createFile(path);
    EXPECT_FALSE(again.file.isOpen());
    EXPECT_EQ(again.error, EEXIST);
    EXPECT_EQ(textOf(path), "first\n");
    EXPECT_EQ(createFile(file("no such folder") / "x").error, ENOENT);
}

TEST_F(Files, AreWrittenAndReadAtOffsets) {
    Locked locked = openLocked(file("a"));
    ASSERT_EQ(locked.lock, Lock::held);
    File& it = locked.opened.file;
    EXPECT_EQ(it.write("0123456789"), 0);
    EXPECT_EQ(it.writeAt("\r\n", 4), 0);
    EXPECT_EQ(it.size(), 10u);
    std::string read(20, '.');
    EXPECT_EQ(it.readAt(std::span(read).first(6), 3), 6u);
    EXPECT_EQ(read.substr(0, 6), "3\r\n678");
    EXPECT_EQ(it.readAt(read, 7), 3u);
    EXPECT_EQ(it.cut(5), 0);
    EXPECT_EQ(it.size(), 5u);
    EXPECT_EQ(it.sync(), 0);
    EXPECT_EQ(it.close(), 0);
    EXPECT_EQ(textOf(file("a")), "0123\r");
}

TEST_F(Files, AreLockedForOneAtATime) {
    const fs::path path = write("locked", "text");
    Locked locked = openLocked(path);
    ASSERT_EQ(locked.lock, Lock::held);
    EXPECT_EQ(openLocked(path).lock, Lock::by_another);
    EXPECT_EQ(textOf(path), "text") << "others may read it";
    locked.opened.file.close();
    EXPECT_EQ(openLocked(path).lock, Lock::held);
    removeOpen(std::move(openLocked(path).opened.file), path);
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(Files, LockOnlyFiles) {
    EXPECT_THAT(openLocked(path_).lock, AnyOf(Lock::is_no_file, Lock::failed));
    EXPECT_EQ(openLocked(file("no such folder") / "x").lock, Lock::failed);
    write("target", "text");
    std::error_code error;
    fs::create_symlink(file("target"), file("link"), error);
    if (error) GTEST_SKIP() << "no links here: " << error.message();
    EXPECT_EQ(openLocked(file("link")).lock, Lock::is_link);
    EXPECT_EQ(createFile(file("link")).error, EEXIST);
    fs::remove(file("target"));
    EXPECT_EQ(createFile(file("link")).error, EEXIST) << "a link to nothing";
    EXPECT_FALSE(fs::exists(file("target")));
}

TEST_F(Files, AreReplacedInOneStep) {
    const fs::path from = write("from", "new"), to = write("to", "old");
    EXPECT_EQ(replaceFile(from, to), 0);
    EXPECT_EQ(textOf(to), "new");
    EXPECT_FALSE(fs::exists(from));
    EXPECT_EQ(replaceFile(from, to), ENOENT);
    EXPECT_EQ(textOf(to), "new");
    EXPECT_EQ(replaceFile(to, file("to another name")), 0);
    EXPECT_EQ(textOf(file("to another name")), "new");
}

TEST_F(Files, TellWhetherTheyCanBeWritten) {
    EXPECT_EQ(checkWriteAccess(path_), 0);
    EXPECT_EQ(checkWriteAccess(write("a", "text")), 0);
    EXPECT_EQ(textOf(file("a")), "text");
    EXPECT_EQ(checkWriteAccess(file("none")), ENOENT);
}

TEST_F(Files, OpenToWriteOnlyWhatIsThere) {
    EXPECT_EQ(openToWrite(file("none")).error, ENOENT);
    EXPECT_FALSE(fs::exists(file("none")));
    Opened opened = openToWrite(write("a", "text"));
    ASSERT_TRUE(opened.file.isOpen());
    EXPECT_EQ(opened.file.write("b"), 0);
    opened.file.close();
    EXPECT_EQ(textOf(file("a")), "bext");
}

TEST(TemporaryFolders, AreNewAndEmpty) {
    const fs::path one = makeTemporaryFolder(), two = makeTemporaryFolder();
    EXPECT_NE(one, two);
    for (const fs::path& each : {one, two}) {
        EXPECT_TRUE(fs::is_empty(each));
        fs::remove(each);
    }
}

TEST(Paths, AreUtf8) {
    const fs::path path(kName);
    EXPECT_EQ(path.string(), kName);
    EXPECT_EQ(path, fs::path(std::u8string(kName.begin(), kName.end())));
}

TEST(Places, KnowThisProgram) {
    EXPECT_EQ(thisProgram().stem(), "test_system");
    EXPECT_TRUE(thisProgram().string().ends_with(kProgramEnding));
    EXPECT_TRUE(fs::is_regular_file(thisProgram()));
}

TEST(Places, AreOfTheUser) {
    const TemporaryFolder folder;
    const fs::path home = folder.file(kName);
    setVariable("XDG_CACHE_HOME", home.string());
    EXPECT_EQ(userFolder(UserFiles::cache), home);
    setVariable("XDG_CACHE_HOME", "relative");
    EXPECT_TRUE(userFolder(UserFiles::cache).is_absolute()) << userFolder(UserFiles::cache);
    EXPECT_NE(userFolder(UserFiles::cache), fs::current_path() / "relative");
}

// ---- The machine --------------------------------------------------------------------------------

TEST(Machine, HasNamesAndMemory) {
    EXPECT_THAT(systemName(), HasSubstr(kIsWindows ? "Windows " : "Linux"));
    EXPECT_THAT(processorName(), Not(IsEmpty()));
    ASSERT_TRUE(memoryBytes());
    EXPECT_GT(*memoryBytes(), std::uint64_t{256} << 20);
}

TEST(Machine, HasTheCLibrarysTime) {
    const std::time_t time = 1'700'000'000;
    const std::tm expected = *std::localtime(&time), local = localTime(time);
    EXPECT_EQ(local.tm_year, expected.tm_year);
    EXPECT_EQ(local.tm_yday, expected.tm_yday);
    EXPECT_EQ(local.tm_hour, expected.tm_hour);
    EXPECT_EQ(local.tm_min, expected.tm_min);
}

TEST(Machine, CountsItsProcessorsTicks) {
    const auto before = readProcessorTicks();
    const auto start = std::chrono::steady_clock::now();
    if (!before) GTEST_SKIP() << "the system counts nothing";
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const auto after = readProcessorTicks();
    const double wall =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ASSERT_TRUE(after);
    EXPECT_LE(after->busy + after->steal, after->total);
    // All processors count, whether they work or not; there may be more than this process may use.
    const double seconds = static_cast<double>(after->total - before->total) / ticksPerSecond();
    EXPECT_GT(seconds, 0.7 * wall * std::thread::hardware_concurrency());
}

TEST(Libraries, AreFoundByName) {
    const Library mathematics(kIsWindows ? "msvcrt.dll" : "libm.so.6");
    const auto cosine = mathematics.find<double (*)(double)>("no_such_function", "cos");
    ASSERT_NE(cosine, nullptr);
    EXPECT_EQ(cosine(0.0), 1.0);
    EXPECT_EQ(mathematics.find<void (*)()>("no_such_function"), nullptr);
    EXPECT_EQ(Library("no_such_library").find<void (*)()>("cos"), nullptr);
    EXPECT_THAT(
        loadedLibraries(), testing::Contains(AnyOf(HasSubstr("libc.so"), HasSubstr("kernel32"))));
}

// ---- This process -------------------------------------------------------------------------------

TEST(ProcessorTime, IsOfTheThreadAndOfTheProcess) {
    constexpr double kTick = 15.625;  // ms between Windows' additions
    const double thread = threadTime(), process = processTime();
    double used = 0.0;
    std::thread([&] {
        const double start = threadTime();
        volatile double sum = 0.0;
        while ((used = threadTime() - start) < 200.0)
            for (int i = 0; i < 1000; ++i) sum = sum + 1.0 / (1.0 + i);
    }).join();
    EXPECT_GE(processTime() - process, used - 2.0 * kTick);
    EXPECT_LT(threadTime() - thread, 100.0) << "it only waited";
}

}  // namespace

int mainOfChild(int count, char** words) {
    prepareStreams();
    return beChild({words + 2, words + count});
}

}  // namespace engine::system

int main(int count, char** words) {
    if (count > 2 && std::string_view(words[1]) == "child")
        return engine::system::mainOfChild(count, words);
    testing::InitGoogleMock(&count, words);
    return RUN_ALL_TESTS();
}
