// A portal for tests, on the bus that DBUS_SESSION_BUS_ADDRESS names:
//
//   mock_portal BEHAVIOUR [URI...]
//
// It prints "ready", then one line for each call. BEHAVIOUR is what it answers to the call that
// opens a dialog; see Respond() and HandleOpen().

#include <systemd/sd-bus.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

constexpr const char* kChooser = "org.freedesktop.portal.FileChooser";
constexpr const char* kRequest = "org.freedesktop.portal.Request";
constexpr const char* kObject = "/org/freedesktop/portal/desktop";

std::string behaviour;
std::vector<std::string> uris;

void Must(int result, const char* what) {
  if (result < 0) {
    std::fprintf(stderr, "mock_portal: %s: %s\n", what, std::strerror(-result));
    std::exit(1);
  }
}

void Say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

// Sends the signal that ends a request. bus: who sends it.
void Respond(sd_bus* bus, const std::string& client, const std::string& handle, uint32_t response) {
  sd_bus_message* signal = nullptr;
  Must(sd_bus_message_new_signal(bus, &signal, handle.c_str(), kRequest, "Response"), "signal");
  Must(sd_bus_message_set_destination(signal, client.c_str()), "destination");
  if (behaviour == "wrong-signature") {
    Must(sd_bus_message_append(signal, "s", "file:///etc/passwd"), "text");
  } else {
    Must(sd_bus_message_append(signal, "u", response), "response");
    Must(sd_bus_message_open_container(signal, 'a', "{sv}"), "results");
    if (behaviour == "wrong-type") {
      Must(sd_bus_message_append(signal, "{sv}", "uris", "s", "file:///etc/passwd"), "text");
    } else if (behaviour != "no-uris") {
      Must(sd_bus_message_append(signal, "{sv}", "choices", "a(ss)", 1, "a", "b"), "choices");
      Must(sd_bus_message_open_container(signal, 'e', "sv"), "entry");
      Must(sd_bus_message_append(signal, "s", "uris"), "key");
      Must(sd_bus_message_open_container(signal, 'v', "as"), "value");
      Must(sd_bus_message_open_container(signal, 'a', "s"), "list");
      for (const std::string& uri : uris) {
        Must(sd_bus_message_append(signal, "s", uri.c_str()), "uri");
      }
      Must(sd_bus_message_close_container(signal), "list");
      Must(sd_bus_message_close_container(signal), "value");
      Must(sd_bus_message_close_container(signal), "entry");
    }
    Must(sd_bus_message_close_container(signal), "results");
  }
  Must(sd_bus_send(bus, signal, nullptr), "send");
  sd_bus_message_unref(signal);
}

// One option of a call as "key=value"; filters as "filters=Videos:*.mp4,*.mov;".
std::string ReadOption(sd_bus_message* call) {
  const char* key = nullptr;
  const char* contents = nullptr;
  Must(sd_bus_message_read(call, "s", &key), "key");
  std::string text = std::string(key) + "=";
  Must(sd_bus_message_peek_type(call, nullptr, &contents), "type");
  const std::string type = contents;
  Must(sd_bus_message_enter_container(call, 'v', contents), "value");
  if (type == "s") {
    const char* value = nullptr;
    Must(sd_bus_message_read(call, "s", &value), "text");
    text += value;
  } else if (type == "b") {
    int value = 0;
    Must(sd_bus_message_read(call, "b", &value), "flag");
    text += std::to_string(value);
  } else if (type == "ay") {
    const void* bytes = nullptr;
    size_t size = 0;
    Must(sd_bus_message_read_array(call, 'y', &bytes, &size), "bytes");
    const bool ends = size > 0 && static_cast<const char*>(bytes)[size - 1] == '\0';
    text += ends ? static_cast<const char*>(bytes) : "(without a zero)";
  } else if (type == "a(sa(us))") {
    Must(sd_bus_message_enter_container(call, 'a', "(sa(us))"), "filters");
    while (sd_bus_message_enter_container(call, 'r', "sa(us)") > 0) {
      const char* label = nullptr;
      Must(sd_bus_message_read(call, "s", &label), "label");
      text += std::string(label) + ":";
      Must(sd_bus_message_enter_container(call, 'a', "(us)"), "patterns");
      uint32_t kind = 0;
      const char* pattern = nullptr;
      while (sd_bus_message_read(call, "(us)", &kind, &pattern) > 0) {
        text += std::string(pattern) + ",";
      }
      text += ";";
      sd_bus_message_exit_container(call);
      sd_bus_message_exit_container(call);
    }
    sd_bus_message_exit_container(call);
  }
  Must(sd_bus_message_exit_container(call), "value");
  return text;
}

// Prints the call and returns the path of its request.
std::string ReadCall(sd_bus_message* call) {
  const char* parent = nullptr;
  const char* title = nullptr;
  Must(sd_bus_message_read(call, "ss", &parent, &title), "call");
  std::string token;
  std::string line =
      std::string(sd_bus_message_get_member(call)) + " parent=" + parent + " title=" + title;
  Must(sd_bus_message_enter_container(call, 'a', "{sv}"), "options");
  while (sd_bus_message_enter_container(call, 'e', "sv") > 0) {
    const std::string option = ReadOption(call);
    if (option.starts_with("handle_token=")) {
      token = option.substr(option.find('=') + 1);
    } else {
      line += " " + option;
    }
    Must(sd_bus_message_exit_container(call), "option");
  }
  Say(line);
  std::string sender = sd_bus_message_get_sender(call) + 1;
  std::replace(sender.begin(), sender.end(), '.', '_');
  return std::string(kObject) + "/request/" + sender + "/" + token;
}

int HandleOpen(sd_bus_message* call) {
  constexpr uint32_t kChosen = 0;
  constexpr uint32_t kCancelled = 1;
  constexpr uint32_t kEnded = 2;
  std::string handle = ReadCall(call);
  sd_bus* bus = sd_bus_message_get_bus(call);
  const std::string client = sd_bus_message_get_sender(call);
  if (behaviour == "error") {
    return sd_bus_reply_method_errorf(call, "org.freedesktop.portal.Error.Failed", "no dialog");
  }
  if (behaviour == "silent") {
    return 1;
  }
  if (behaviour == "vanish") {
    Must(sd_bus_reply_method_return(call, "o", handle.c_str()), "reply");
    Must(sd_bus_flush(bus), "flush");
    std::exit(0);
  }
  if (behaviour == "early") {  // The answer comes before the reply.
    Respond(bus, client, handle, kChosen);
    return sd_bus_reply_method_return(call, "o", handle.c_str());
  }
  if (behaviour == "old-handle") {
    handle = "/org/freedesktop/portal/desktop/request/of_an_old_portal";
  }
  if (behaviour == "bad-reply") {
    return sd_bus_reply_method_return(call, "s", "not an object");
  }
  Must(sd_bus_reply_method_return(call, "o", handle.c_str()), "reply");
  if (behaviour == "stranger") {  // Another program answers first.
    sd_bus* other = nullptr;
    Must(sd_bus_open_user(&other), "second connection");
    Respond(other, client, handle, kChosen);
    Must(sd_bus_flush(other), "flush");
    sd_bus_close_unref(other);
    Respond(bus, client, handle, kCancelled);
  } else if (behaviour == "cancel") {
    Respond(bus, client, handle, kCancelled);
  } else if (behaviour == "end") {
    Respond(bus, client, handle, kEnded);
  } else if (behaviour != "wait") {
    Respond(bus, client, handle, kChosen);
  }
  return 1;
}

int Handle(sd_bus_message* call, void*, sd_bus_error*) {
  if (sd_bus_message_is_method_call(call, kRequest, "Close") > 0) {
    Say("Close");
    return sd_bus_reply_method_return(call, "");
  }
  if (sd_bus_message_is_method_call(call, "org.freedesktop.DBus.Properties", "Get") > 0) {
    if (behaviour == "no-chooser") {
      return sd_bus_reply_method_errorf(call, SD_BUS_ERROR_UNKNOWN_INTERFACE, "no such interface");
    }
    return behaviour == "no-version"
               ? 1
               : sd_bus_reply_method_return(call, "v", "u", behaviour == "version-1" ? 1u : 4u);
  }
  return sd_bus_message_is_method_call(call, kChooser, nullptr) > 0 ? HandleOpen(call) : 0;
}

}  // namespace

int main(int argc, char** argv) {
  behaviour = argc > 1 ? argv[1] : "cancel";
  uris.assign(argv + std::min(argc, 2), argv + argc);
  sd_bus* bus = nullptr;
  Must(sd_bus_open_user(&bus), "bus");
  Must(sd_bus_add_fallback(bus, nullptr, kObject, Handle, nullptr), "object");
  // A portal of the same test that was killed may still have the name for a moment.
  Must(sd_bus_request_name(bus, "org.freedesktop.portal.Desktop",
                           SD_BUS_NAME_ALLOW_REPLACEMENT | SD_BUS_NAME_REPLACE_EXISTING),
       "name");
  Say("ready");
  for (;;) {
    const int result = sd_bus_process(bus, nullptr);
    Must(result, "process");
    if (result == 0) {
      Must(sd_bus_wait(bus, UINT64_MAX), "wait");
    }
  }
}
