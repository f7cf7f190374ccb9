#pragma once

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

// A test's own X server without a screen, so that windows can be as large as they ask. Without
// Xvfb, the desktop that started the test, if any.
class VirtualDisplay {
public:
    VirtualDisplay() {
        int ends[2];
        if (pipe(ends) != 0) return;
        server_ = fork();
        if (server_ == 0) runServer(ends);
        close(ends[1]);
        // It writes its number when windows can be opened, or ends without one if that fails.
        std::string number;
        char letter = 0;
        while (read(ends[0], &letter, 1) == 1 && letter != '\n') number += letter;
        close(ends[0]);
        if (!number.empty()) {
            name_ = ':' + number;
            variables_ = "env -u WAYLAND_DISPLAY DISPLAY=:" + number + ' ';
        } else if (std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY")) {
            variables_ = "env ";
        }
    }
    ~VirtualDisplay() {
        if (server_ <= 0) return;
        kill(server_, SIGTERM);
        while (waitpid(server_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    // Returns the prefix for a command that opens windows there; nothing without a display.
    const std::optional<std::string>& variables() const { return variables_; }

    // ":1", for DISPLAY; empty without Xvfb.
    const std::string& name() const { return name_; }

private:
    [[noreturn]] static void runServer(const int (&ends)[2]) {
        const int nowhere = open("/dev/null", O_RDWR);
        dup2(nowhere, STDIN_FILENO);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        close(ends[0]);
        const std::string end = std::to_string(ends[1]);
        execlp(
            "Xvfb", "Xvfb", "-displayfd", end.c_str(), "-screen", "0", "2560x1600x24", "-nolisten",
            "tcp", static_cast<char*>(nullptr));
        _exit(127);
    }

    pid_t server_ = -1;
    std::string name_;
    std::optional<std::string> variables_;
};
