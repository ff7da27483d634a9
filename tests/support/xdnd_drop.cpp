// xdnd_drop WINDOW FILE ...: drops files on a window, as a file manager does. Ends with 0 when the window
// took them. Source: "Drag-and-Drop Protocol for the X Window System", version 5 (freedesktop.org).
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

struct Drop {
    Display* display;
    Window own, target;
    std::string list;  // of addresses of files, each with its line's end

    [[nodiscard]] Atom atom(const char* name) const { return XInternAtom(display, name, False); }

    void send(const char* type, long first, long second, long third, long fourth) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(own);
        event.xclient.data.l[1] = first;
        event.xclient.data.l[2] = second;
        event.xclient.data.l[3] = third;
        event.xclient.data.l[4] = fourth;
        XSendEvent(display, target, False, NoEventMask, &event);
        XFlush(display);
    }

    // What the target asks for is the list.
    void answer(const XSelectionRequestEvent& asked) const {
        XChangeProperty(display, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(list.data()), static_cast<int>(list.size()));
        XEvent notice{};
        notice.xselection.type = SelectionNotify;
        notice.xselection.requestor = asked.requestor;
        notice.xselection.selection = asked.selection;
        notice.xselection.target = asked.target;
        notice.xselection.property = asked.property;
        notice.xselection.time = asked.time;
        XSendEvent(display, asked.requestor, False, NoEventMask, &notice);
        XFlush(display);
    }

    // The second number of a message of this type, or -1 where none comes in time.
    [[nodiscard]] long await(const char* type) const {
        const Atom awaited = atom(type);
        const auto end = Clock::now() + std::chrono::seconds(60);
        while (Clock::now() < end) {
            if (XPending(display) == 0) {
                pollfd ready{ConnectionNumber(display), POLLIN, 0};
                poll(&ready, 1, 100);
                continue;
            }
            XEvent event;
            XNextEvent(display, &event);
            if (event.type == SelectionRequest) answer(event.xselectionrequest);
            if (event.type == ClientMessage && event.xclient.message_type == awaited)
                return event.xclient.data.l[1];
        }
        return -1;
    }
};

}  // namespace

// A file's address: what is neither letter, digit, nor one of "/._-" is percent-encoded (RFC 3986).
static std::string address_of(const std::string& file) {
    std::string address = "file://";
    for (const char c : file) {
        char code[4] = {c, 0};
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                              std::string("/._-").find(c) != std::string::npos;
        if (!is_plain)
            std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
        address += code;
    }
    return address + "\r\n";
}

int main(int count, char** words) {
    if (count < 3) return 2;
    Display* const display = XOpenDisplay(nullptr);
    if (display == nullptr) return 3;
    const Window root = DefaultRootWindow(display);
    Drop drop{display, XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, 0, 0),
              std::strtoul(words[1], nullptr, 0), ""};
    for (int i = 2; i < count; ++i) drop.list += address_of(words[i]);
    XSetSelectionOwner(display, drop.atom("XdndSelection"), drop.own, CurrentTime);
    constexpr long version = 5L << 24;
    constexpr long at_px = (60L << 16) | 60L;  // of the screen
    drop.send("XdndEnter", version, static_cast<long>(drop.atom("text/uri-list")), 0, 0);
    drop.send("XdndPosition", 0, at_px, CurrentTime, static_cast<long>(drop.atom("XdndActionCopy")));
    if (drop.await("XdndStatus") <= 0) {
        std::fputs("the window takes nothing\n", stderr);
        return 1;
    }
    drop.send("XdndDrop", 0, CurrentTime, 0, 0);
    const bool taken = drop.await("XdndFinished") > 0;  // GLFW says how many bytes
    XCloseDisplay(display);
    return taken ? 0 : 1;
}
