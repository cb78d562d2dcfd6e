// Drops files on a window, as a file manager does (XDND, version 5):
//
//   drop_files WINDOW URI...
//
// WINDOW is a number, as xdotool prints it. Fails if the window does not take the files within five
// seconds.

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

class Source {
 public:
  Source(Display* display, Window target, std::string uris)
      : display_(display), target_(target), uris_(std::move(uris)) {
    window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display_, Named("XdndSelection"), window_, CurrentTime);
  }

  // Returns whether the window has taken the files.
  bool Drop() {
    constexpr long kVersion = 5;
    Window child = 0;
    int x = 0;
    int y = 0;
    XWindowAttributes size = {};
    XGetWindowAttributes(display_, target_, &size);
    XTranslateCoordinates(display_, target_, DefaultRootWindow(display_), size.width / 2,
                          size.height / 2, &x, &y, &child);
    Send("XdndEnter", kVersion << 24, static_cast<long>(Named("text/uri-list")), 0, 0);
    Send("XdndPosition", 0, x << 16 | y, CurrentTime, static_cast<long>(Named("XdndActionCopy")));
    constexpr int kTries = 500;
    for (int i = 0; i < kTries; ++i) {
      while (XPending(display_) > 0) {
        XEvent event = {};
        XNextEvent(display_, &event);
        if (event.type == SelectionRequest) {
          Answer(event.xselectionrequest);
        } else if (event.type == ClientMessage &&
                   event.xclient.message_type == Named("XdndStatus")) {
          if ((event.xclient.data.l[1] & 1) == 0) {
            return false;
          }
          Send("XdndDrop", 0, CurrentTime, 0, 0);
        } else if (event.type == ClientMessage &&
                   event.xclient.message_type == Named("XdndFinished")) {
          return event.xclient.data.l[1] != 0;  // GLFW sends the size of what it has read.
        }
      }
      usleep(10'000);
    }
    return false;
  }

 private:
  Atom Named(const char* name) { return XInternAtom(display_, name, False); }

  void Send(const char* type, long first, long second, long third, long fourth) {
    XEvent event = {};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = Named(type);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(window_);
    event.xclient.data.l[1] = first;
    event.xclient.data.l[2] = second;
    event.xclient.data.l[3] = third;
    event.xclient.data.l[4] = fourth;
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XFlush(display_);
  }

  void Answer(const XSelectionRequestEvent& request) {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(uris_.data()),
                    static_cast<int>(uris_.size()));
    XEvent event = {};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display_, request.requestor, False, NoEventMask, &event);
    XFlush(display_);
  }

  Display* display_;
  Window target_;
  Window window_ = 0;
  std::string uris_;
};

}  // namespace

int main(int argc, char** argv) {
  Display* display = XOpenDisplay(nullptr);
  if (argc < 3 || display == nullptr) {
    std::fprintf(stderr, "drop_files WINDOW URI...: needs a display\n");
    return 2;
  }
  std::string uris;
  for (int i = 2; i < argc; ++i) {
    uris += std::string(argv[i]) + "\r\n";
  }
  const bool taken = Source(display, std::strtoul(argv[1], nullptr, 0), uris).Drop();
  XCloseDisplay(display);
  return taken ? 0 : 1;
}
