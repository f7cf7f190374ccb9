#pragma once

#include <functional>
#include <string>
#include <vector>

struct ImGuiContext;
struct ImGuiContextHook;
struct ImGuiIO;

namespace benchmarks {

// A mouse and a keyboard for Dear ImGui's current context, in place of the user's: what GLFW told
// of those is dropped just before widgets would see it. Time is no clock's either, but 1/60 s from
// picture to picture, so that a double click is one on a slow machine. What is called between two
// pictures is seen by the second. Must not outlive the context.
class UserInput {
public:
    UserInput();
    ~UserInput();
    UserInput(const UserInput&) = delete;
    UserInput& operator=(const UserInput&) = delete;

    // px from the window's top left corner.
    void move(float x, float y);
    enum class Change { press, release };
    void button(int button, Change change);  // ImGuiMouseButton
    void wheel(float x, float y);            // notches; up and left are positive
    void key(int chord, Change change);      // ImGuiKeyChord
    void type(const std::string& text);

private:
    static void feed(ImGuiContext* context, ImGuiContextHook* hook);

    unsigned hook_ = 0;
    bool trickles_ = true;  // as it was before
    std::vector<std::function<void(ImGuiIO&)>> events_;
};

}  // namespace benchmarks
