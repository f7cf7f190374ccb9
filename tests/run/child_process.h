#pragma once

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// The program as a process that can be stopped at any moment. Its output goes into `log`.
class ChildProcess {
public:
    ChildProcess(
        std::vector<std::string> arguments, const std::filesystem::path& log,
        std::optional<rlim_t> file_size = {}) {
        arguments.insert(arguments.begin(), HAIRBENCH_PROGRAM);
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        id_ = fork();
        if (id_ != 0) return;
        const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
        if (file_size) {
            const rlimit limit{*file_size, *file_size};
            setrlimit(RLIMIT_FSIZE, &limit);
        }
        execv(argv[0], argv.data());
        _exit(127);
    }
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess() {
        if (status_) return;
        kill(SIGKILL);
        wait();
    }

    void kill(int signal) const { ::kill(id_, signal); }

    // Returns the exit status, or 128 + the number of the signal that ended it, as a shell does.
    int wait() {
        int status = 0;
        if (!status_ && waitpid(id_, &status, 0) == id_) status_ = status;
        const int last = status_.value_or(-1);
        return WIFEXITED(last) ? WEXITSTATUS(last) : 128 + WTERMSIG(last);
    }

private:
    pid_t id_;
    std::optional<int> status_;
};
