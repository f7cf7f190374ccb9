#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

// A shell in a terminal, with the keys that a person would type.
class TypedShell {
public:
    explicit TypedShell(const std::vector<std::string>& words) {
        const winsize size{.ws_row = 50, .ws_col = 400, .ws_xpixel = 0, .ws_ypixel = 0};
        child_ = forkpty(&terminal_, nullptr, nullptr, &size);
        if (child_ < 0) throw std::runtime_error("forkpty failed");
        if (child_ > 0) return;
        std::vector<char*> arguments;
        for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        setenv("TERM", "dumb", 1);
        execvp(arguments.front(), arguments.data());
        _exit(127);
    }
    ~TypedShell() {
        close(terminal_);
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
    TypedShell(const TypedShell&) = delete;
    TypedShell& operator=(const TypedShell&) = delete;

    void type(const std::string& keys) const {
        if (write(terminal_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
            throw std::runtime_error("the terminal takes no keys");
    }

    // Returns the terminal's output since the last wait, up to the end of `text`, or all of it if
    // the text does not come within 30 s.
    std::string waitFor(const std::string& text) {
        using Clock = std::chrono::steady_clock;
        const auto end = Clock::now() + std::chrono::seconds(30);
        for (;;) {
            if (const std::size_t at = shown_.find(text); at != std::string::npos) {
                const std::string seen = shown_.substr(0, at + text.size());
                shown_.erase(0, at + text.size());
                return seen;
            }
            pollfd ready{.fd = terminal_, .events = POLLIN, .revents = 0};
            char part[4096];
            if (Clock::now() > end || poll(&ready, 1, 1000) < 0) return shown_;
            if (ready.revents == 0) continue;
            const ssize_t count = read(terminal_, part, sizeof part);
            if (count <= 0) return shown_;  // the shell has ended
            shown_.append(part, static_cast<std::size_t>(count));
        }
    }

private:
    int terminal_ = -1;
    pid_t child_ = -1;
    std::string shown_;
};
