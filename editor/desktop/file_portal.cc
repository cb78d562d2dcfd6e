#include "editor/desktop/file_portal.h"

#include <systemd/sd-bus.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <utility>

#include "editor/desktop/file_uri.h"
#include "shared/core/utf8.h"

namespace lararium::editor {

namespace {

constexpr const char* kService = "org.freedesktop.portal.Desktop";
constexpr const char* kObject = "/org/freedesktop/portal/desktop";
constexpr const char* kChooser = "org.freedesktop.portal.FileChooser";
constexpr const char* kRequest = "org.freedesktop.portal.Request";
constexpr uint32_t kChoosesFolders = 3;  // The first version of the interface that does.

struct MessageDeleter {
  void operator()(sd_bus_message* message) const { sd_bus_message_unref(message); }
};
using Message = std::unique_ptr<sd_bus_message, MessageDeleter>;

struct BusDeleter {
  void operator()(sd_bus* bus) const { sd_bus_close_unref(bus); }
};

// The first negative result of the calls.
class Results {
 public:
  void operator+=(int result) {
    if (first_ >= 0) {
      first_ = result;
    }
  }
  bool ok() const { return first_ >= 0; }

 private:
  int first_ = 0;
};

std::string ErrorText(const sd_bus_error* error) {
  return error != nullptr && error->message != nullptr ? error->message : "it does not answer";
}

// The bus closes the connection of a program that sends a text which is not UTF-8.
std::string Sendable(const std::string& text) { return IsUtf8(text) ? text : ""; }

Results AppendFilters(sd_bus_message* call, const std::vector<FileFilter>& filters) {
  constexpr uint32_t kGlob = 0;
  Results results;
  results += sd_bus_message_open_container(call, 'e', "sv");
  results += sd_bus_message_append(call, "s", "filters");
  results += sd_bus_message_open_container(call, 'v', "a(sa(us))");
  results += sd_bus_message_open_container(call, 'a', "(sa(us))");
  for (const FileFilter& filter : filters) {
    results += sd_bus_message_open_container(call, 'r', "sa(us)");
    results += sd_bus_message_append(call, "s", filter.label.c_str());
    results += sd_bus_message_open_container(call, 'a', "(us)");
    for (const std::string& extension : filter.extensions) {
      results += sd_bus_message_append(call, "(us)", kGlob, AnyCasePattern(extension).c_str());
    }
    results += sd_bus_message_close_container(call);
    results += sd_bus_message_close_container(call);
  }
  results += sd_bus_message_close_container(call);
  results += sd_bus_message_close_container(call);
  results += sd_bus_message_close_container(call);
  return results;
}

bool AppendOptions(sd_bus_message* call, const FileRequest& request, const std::string& token) {
  using Kind = FileRequest::Kind;
  Results results;
  results += sd_bus_message_open_container(call, 'a', "{sv}");
  results += sd_bus_message_append(call, "{sv}", "handle_token", "s", token.c_str());
  results += sd_bus_message_append(call, "{sv}", "modal", "b", 1);
  if (request.kind == Kind::kFolder) {
    results += sd_bus_message_append(call, "{sv}", "directory", "b", 1);
  } else if (!request.filters.empty()) {
    results += AppendFilters(call, request.filters).ok() ? 0 : -1;
  }
  if (request.kind == Kind::kSave && !Sendable(request.name).empty()) {
    results += sd_bus_message_append(call, "{sv}", "current_name", "s", request.name.c_str());
  }
  if (!request.folder.empty()) {  // The portal takes bytes with a zero at their end.
    results += sd_bus_message_open_container(call, 'e', "sv");
    results += sd_bus_message_append(call, "s", "current_folder");
    results += sd_bus_message_open_container(call, 'v', "ay");
    results += sd_bus_message_append_array(call, 'y', request.folder.c_str(),
                                           request.folder.native().size() + 1);
    results += sd_bus_message_close_container(call);
    results += sd_bus_message_close_container(call);
  }
  results += sd_bus_message_close_container(call);
  return results.ok();
}

// Reads the one URI of the results of an answer; empty where there is not exactly one.
std::string ReadUri(sd_bus_message* answer) {
  std::string uri;
  int count = 0;
  if (sd_bus_message_enter_container(answer, 'a', "{sv}") < 0) {
    return "";
  }
  while (sd_bus_message_enter_container(answer, 'e', "sv") > 0) {
    const char* key = nullptr;
    const char* contents = nullptr;
    if (sd_bus_message_read(answer, "s", &key) < 0) {
      return "";
    }
    const bool uris = std::strcmp(key, "uris") == 0 &&
                      sd_bus_message_peek_type(answer, nullptr, &contents) > 0 &&
                      std::strcmp(contents, "as") == 0;
    if (!uris) {
      if (sd_bus_message_skip(answer, "v") < 0) {
        return "";
      }
    } else {
      sd_bus_message_enter_container(answer, 'v', "as");
      sd_bus_message_enter_container(answer, 'a', "s");
      const char* text = nullptr;
      while (sd_bus_message_read(answer, "s", &text) > 0) {
        uri = text;
        ++count;
      }
      sd_bus_message_exit_container(answer);
      sd_bus_message_exit_container(answer);
    }
    sd_bus_message_exit_container(answer);
  }
  return count == 1 ? uri : "";
}

}  // namespace

std::string AnyCasePattern(const std::string& extension) {
  std::string pattern = "*";
  for (const char c : extension) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) == 0) {
      pattern += c;
    } else {
      pattern += {'[', static_cast<char>(std::tolower(letter)),
                  static_cast<char>(std::toupper(letter)), ']'};
    }
  }
  return pattern;
}

struct FilePortal::State {
  enum class Phase { kAsking, kThere, kMissing };
  struct Waiting {
    FileRequest request;
    std::string parent_window;
  };

  explicit State(std::chrono::milliseconds wait) : timeout(wait) {
    sd_bus* opened = nullptr;
    if (sd_bus_open_user(&opened) < 0) {
      Lose("there is no session bus");
      return;
    }
    bus.reset(opened);
    Results results;
    results += sd_bus_match_signal_async(bus.get(), nullptr, kService, nullptr, kRequest,
                                         "Response", OnResponse, nullptr, this);
    results += sd_bus_match_signal_async(bus.get(), nullptr, "org.freedesktop.DBus",
                                         "/org/freedesktop/DBus", "org.freedesktop.DBus",
                                         "NameOwnerChanged", OnOwner, nullptr, this);
    sd_bus_message* call = nullptr;
    results += sd_bus_message_new_method_call(bus.get(), &call, kService, kObject,
                                              "org.freedesktop.DBus.Properties", "Get");
    const Message owned(call);
    results += call == nullptr ? -1 : sd_bus_message_append(call, "ss", kChooser, "version");
    results += call == nullptr ? -1 : Send(call, OnVersion);
    if (!results.ok()) {
      Lose("the session bus takes no call");
    }
  }

  int Send(sd_bus_message* call, sd_bus_message_handler_t handler) {
    const auto wait = std::chrono::duration_cast<std::chrono::microseconds>(timeout);
    // A floating slot: it lives as long as the bus.
    return sd_bus_call_async(bus.get(), nullptr, call, handler, this,
                             static_cast<uint64_t>(wait.count()));
  }

  void Lose(const std::string& why) {
    phase = Phase::kMissing;
    problem = why;
    if (waiting || open) {
      Answer({FileAnswer::Outcome::kFailed, {}, why});
    }
  }

  void Answer(FileAnswer given) {
    waiting.reset();
    open = false;
    answer = std::move(given);
  }

  void Begin(const Waiting& wanted) {
    const FileRequest& request = wanted.request;
    if (request.kind == FileRequest::Kind::kFolder && version < kChoosesFolders) {
      Answer({FileAnswer::Outcome::kFailed, {}, "the desktop's dialog cannot choose folders"});
      return;
    }
    const std::string token = "lararium" + std::to_string(++requests);
    const char* unique = nullptr;
    sd_bus_get_unique_name(bus.get(), &unique);
    std::string sender = unique != nullptr && unique[0] == ':' ? unique + 1 : "";
    std::replace(sender.begin(), sender.end(), '.', '_');
    handle = kObject;
    handle.append("/request/").append(sender).append("/").append(token);
    open = true;
    sd_bus_message* call = nullptr;
    Results results;
    results += sd_bus_message_new_method_call(
        bus.get(), &call, kService, kObject, kChooser,
        request.kind == FileRequest::Kind::kSave ? "SaveFile" : "OpenFile");
    const Message owned(call);
    if (results.ok()) {
      results += sd_bus_message_append(call, "ss", wanted.parent_window.c_str(),
                                       Sendable(request.title).c_str());
      results += AppendOptions(call, request, token) ? 0 : -1;
      results += Send(call, OnHandle);
    }
    if (!results.ok()) {
      Answer({FileAnswer::Outcome::kFailed, {}, "the desktop's dialog cannot be asked"});
    }
  }

  void CloseDialog() {
    if (open && bus != nullptr) {
      sd_bus_call_method_async(bus.get(), nullptr, kService, handle.c_str(), kRequest, "Close",
                               nullptr, nullptr, "");
    }
    waiting.reset();
    answer.reset();
    open = false;
  }

  static State& Of(void* data) { return *static_cast<State*>(data); }

  static int OnVersion(sd_bus_message* reply, void* data, sd_bus_error*) {
    State& state = Of(data);
    if (sd_bus_message_is_method_error(reply, nullptr) != 0 ||
        sd_bus_message_read(reply, "v", "u", &state.version) < 0 || state.version == 0) {
      state.Lose(ErrorText(sd_bus_message_get_error(reply)));
      return 0;
    }
    const char* sender = sd_bus_message_get_sender(reply);
    state.owner = sender != nullptr ? sender : "";
    state.phase = Phase::kThere;
    if (state.waiting) {
      state.Begin(*std::exchange(state.waiting, std::nullopt));
    }
    return 0;
  }

  // The reply to the call that opens the dialog. Portals before 0.9 choose the handle themselves.
  static int OnHandle(sd_bus_message* reply, void* data, sd_bus_error*) {
    State& state = Of(data);
    if (!state.open) {
      return 0;  // The reply belongs to a dialog that was closed or answered meanwhile.
    }
    const char* handle = nullptr;
    if (sd_bus_message_is_method_error(reply, nullptr) != 0) {
      state.Answer({FileAnswer::Outcome::kFailed, {}, ErrorText(sd_bus_message_get_error(reply))});
    } else if (sd_bus_message_read(reply, "o", &handle) < 0) {
      state.Answer({FileAnswer::Outcome::kFailed, {}, "the desktop's answer cannot be read"});
    } else {
      state.handle = handle;
    }
    return 0;
  }

  static int OnResponse(sd_bus_message* signal, void* data, sd_bus_error*) {
    constexpr uint32_t kChosen = 0;
    constexpr uint32_t kCancelled = 1;
    State& state = Of(data);
    const char* path = sd_bus_message_get_path(signal);
    const char* sender = sd_bus_message_get_sender(signal);
    if (!state.open || path == nullptr || state.handle != path || sender == nullptr ||
        state.owner != sender) {
      return 0;
    }
    uint32_t response = 2;
    if (sd_bus_message_read(signal, "u", &response) < 0) {
      state.Answer({FileAnswer::Outcome::kFailed, {}, "the desktop's answer cannot be read"});
    } else if (response == kCancelled) {
      state.Answer({FileAnswer::Outcome::kCancelled, {}, ""});
    } else if (response != kChosen) {
      state.Answer({FileAnswer::Outcome::kFailed, {}, "the desktop has closed its dialog"});
    } else {
      state.Choose(ReadUri(signal));
    }
    return 0;
  }

  void Choose(const std::string& uri) {
    if (uri.empty()) {
      Answer({FileAnswer::Outcome::kFailed, {}, "the desktop's answer names no file"});
      return;
    }
    const Result<std::filesystem::path> path = PathOfUri(uri);
    Answer(path.ok() ? FileAnswer{FileAnswer::Outcome::kChosen, *path, ""}
                     : FileAnswer{FileAnswer::Outcome::kRefused, {}, path.message()});
  }

  // The portal has ended, or another program has taken its name.
  static int OnOwner(sd_bus_message* signal, void* data, sd_bus_error*) {
    State& state = Of(data);
    const char* name = nullptr;
    const char* before = nullptr;
    const char* after = nullptr;
    if (sd_bus_message_read(signal, "sss", &name, &before, &after) < 0 ||
        std::strcmp(name, kService) != 0 || state.phase != Phase::kThere) {
      return 0;
    }
    state.owner = after;
    if (state.open) {
      state.Answer({FileAnswer::Outcome::kFailed, {}, "the desktop's dialog has ended"});
    }
    return 0;
  }

  std::chrono::milliseconds timeout;
  std::unique_ptr<sd_bus, BusDeleter> bus;
  Phase phase = Phase::kAsking;
  std::string problem;  // kMissing: why.
  std::string owner;    // The unique name of the portal on the bus.
  uint32_t version = 0;
  std::optional<Waiting> waiting;  // The request that is sent when the portal has answered.
  bool open = false;               // A dialog was asked for and has not been answered.
  std::string handle;              // The object of the open dialog.
  int requests = 0;
  std::optional<FileAnswer> answer;
};

FilePortal::FilePortal(std::chrono::milliseconds timeout)
    : state_(std::make_unique<State>(timeout)) {}

FilePortal::~FilePortal() = default;

void FilePortal::Update() {
  if (state_->bus == nullptr) {
    return;
  }
  int result = 1;
  while (result > 0) {
    result = sd_bus_process(state_->bus.get(), nullptr);
  }
  if (result < 0) {
    state_->bus.reset();
    state_->Lose("the session bus has closed the connection");
  }
}

void FilePortal::Open(const FileRequest& request, const std::string& parent_window) {
  state_->CloseDialog();
  switch (state_->phase) {
    case State::Phase::kAsking:
      state_->waiting = {request, parent_window};
      break;
    case State::Phase::kThere:
      state_->Begin({request, parent_window});
      break;
    case State::Phase::kMissing:
      state_->Answer({FileAnswer::Outcome::kFailed, {}, state_->problem});
      break;
  }
}

void FilePortal::Close() { state_->CloseDialog(); }

bool FilePortal::busy() const { return state_->waiting || state_->open || state_->answer; }

std::optional<FileAnswer> FilePortal::TakeAnswer() {
  return std::exchange(state_->answer, std::nullopt);
}

}  // namespace lararium::editor
