#include "player/fleet/fleet_client.h"

#include <mosquitto.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/time.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <iterator>
#include <optional>
#include <span>

#include "player/kiosk/secret_file.h"
#include "player/staff/staff_messages.h"
#include "shared/bundle/sha256.h"
#include "shared/core/check.h"
#include "shared/core/file.h"

namespace lararium::player {
namespace {

// The broker notices within one and a half times this that a device is gone.
constexpr int kKeepAliveSeconds = 5;  // The shortest that libmosquitto accepts.
constexpr int kPollMs = 100;
constexpr int kPollInGroupMs = 20;
constexpr int kUnanswered = 100;  // Messages on their way to the broker.
constexpr long kConnectSeconds = 10;
constexpr int kTryMs = 10'000;  // time that a broker has to answer the doctor
constexpr char kTrustedBySystem[] = "/etc/ssl/certs";
constexpr std::chrono::seconds kLongestPause(30);
constexpr std::chrono::seconds kLongestPauseInGroup(1);  // The group waits for the device.
// At least the first time passes between two states, and at most the second.
constexpr std::chrono::milliseconds kLeastBetween(500);
constexpr std::chrono::milliseconds kMostBetween(2000);
constexpr std::chrono::minutes kBetweenStatistics(5);
constexpr int kOnce = 2;         // Quality of service: a command arrives exactly once.
constexpr int kAtLeastOnce = 1;  // Quality of service of presence and of a group's events.
constexpr int kNewestWins = 0;   // Quality of service of states and of a group's beats.

constexpr char kOnline[] = R"({"online": true})";
constexpr char kOffline[] = R"({"online": false})";

// Says what a code of libmosquitto means.
std::string TextOf(int code) {
  if (code != MOSQ_ERR_ERRNO) {
    return mosquitto_strerror(code);
  }
  return errno == EINTR ? "it does not answer" : std::strerror(errno);
}

const char* OrNull(const std::filesystem::path& path) {
  return path.empty() ? nullptr : path.c_str();
}

// Makes a client that knows how to prove its name. kind: beginning of the name of its session; the
// broker ends an older session of the same name.
Result<MosquittoClient> MakeClient(const FleetOptions& options,
                                   const std::string& kind,
                                   void* user) {
  constexpr bool kForget = true;  // The broker keeps no commands for a device that is away.
  // Clients that know the name of a session can end it: visitors' pages must not know it.
  LARARIUM_ASSIGN_OR_RETURN(std::string secret, options.password.empty()
                                                    ? ReadText(options.key)
                                                    : ReadSecretLine(options.password));
  const std::string id =
      kind + "-" + options.broker().site + "-" + options.name + "-" +
      bundle::FormatSha256(bundle::ComputeSha256(std::as_bytes(std::span(secret)))).substr(0, 16);
  mosquitto_lib_init();
  MosquittoClient client(mosquitto_new(id.c_str(), kForget, user));
  if (client == nullptr) {
    return Status::Error("fleet", TextOf(MOSQ_ERR_ERRNO));
  }
  const int named =
      options.password.empty()
          ? MOSQ_ERR_SUCCESS
          : mosquitto_username_pw_set(client.get(), options.name.c_str(), secret.c_str());
  ::explicit_bzero(secret.data(), secret.size());
  if (named != MOSQ_ERR_SUCCESS) {
    return Status::Error(options.password.string(), TextOf(named));
  }
  // Without the function, OpenSSL would ask for the password of an encrypted key.
  const auto no_password = [](char* /*text*/, int /*size*/, int /*use*/, void* /*data*/) {
    return 0;
  };
  if (const int code =
          mosquitto_tls_set(client.get(), OrNull(options.authority),
                            options.authority.empty() ? kTrustedBySystem : nullptr,
                            OrNull(options.certificate), OrNull(options.key), no_password);
      code != MOSQ_ERR_SUCCESS) {
    return Status::Error("fleet", TextOf(code), "check the files with the certificates");
  }
  // The signal of ConnectInTime() does nothing but interrupt.
  struct sigaction interrupt = {};
  interrupt.sa_handler = [](int) {};
  ::sigaction(SIGALRM, &interrupt, nullptr);
  return client;
}

int64_t Microseconds(clockid_t clock) {
  timespec now = {};
  ::clock_gettime(clock, &now);
  return int64_t{1'000'000} * now.tv_sec + now.tv_nsec / 1000;
}

uint64_t RandomNumber() {
  uint64_t number = 0;
  CHECK(::getrandom(&number, sizeof(number), 0) == sizeof(number));
  return number;
}

// A host may have several addresses; each is given up after a while by a signal.
int ConnectInTime(mosquitto* client, const FleetAddress& broker) {
  const itimerval signals = {{kConnectSeconds, 0}, {kConnectSeconds, 0}};
  const itimerval none = {};
  ::setitimer(ITIMER_REAL, &signals, nullptr);
  const int code = mosquitto_connect(client, broker.host.c_str(), broker.port, kKeepAliveSeconds);
  ::setitimer(ITIMER_REAL, &none, nullptr);
  return code;
}

}  // namespace

void FreeMosquitto::operator()(mosquitto* client) const {
  mosquitto_destroy(client);
  mosquitto_lib_cleanup();
}

Status TryFleet(const FleetOptions& options) {
  struct Answer {
    std::optional<int> code;
    std::string error;
  } answer;
  LARARIUM_ASSIGN_OR_RETURN(const MosquittoClient client, MakeClient(options, "doctor", &answer));
  mosquitto_connect_callback_set(client.get(), [](mosquitto* /*client*/, void* user, int code) {
    static_cast<Answer*>(user)->code = code;
  });
  mosquitto_log_callback_set(client.get(),
                             [](mosquitto* /*client*/, void* user, int level, const char* text) {
                               if (level == MOSQ_LOG_ERR) {
                                 static_cast<Answer*>(user)->error = text;
                               }
                             });
  int code = ConnectInTime(client.get(), options.broker());
  for (int waited = 0; code == MOSQ_ERR_SUCCESS && !answer.code; waited += kPollMs) {
    code = waited < kTryMs ? mosquitto_loop(client.get(), kPollMs, 1) : MOSQ_ERR_NO_CONN;
  }
  if (answer.code == 0) {
    mosquitto_disconnect(client.get());
    return Status();
  }
  return Status::Error(options.address, answer.code ? mosquitto_connack_string(*answer.code)
                                        : !answer.error.empty() ? answer.error
                                                                : TextOf(code));
}

struct FleetClient::Calls {
  static void Connected(mosquitto* /*client*/, void* self, int code) {
    static_cast<FleetClient*>(self)->Connected(code);
  }
  // Errors of TLS are told only here.
  static void Logged(mosquitto* /*client*/, void* self, int level, const char* text) {
    if (level == MOSQ_LOG_ERR) {
      static_cast<FleetClient*>(self)->library_says_ = text;
    }
  }
  static void Received(mosquitto* /*client*/, void* self, const mosquitto_message* message) {
    static_cast<FleetClient*>(self)->Take(*message);
  }
};

FleetClient::FleetClient(const FleetOptions& options, int link)
    : broker_(options.broker()),
      topics_(TopicsOf(broker_.site, options.name, options.group)),
      name_(options.name),
      group_(options.group),
      link_(link) {
  if (!group_.empty()) {
    relay_.emplace(group::GroupMemberOptions{
        .name = name_, .guide = options.guide, .boot = RandomNumber(), .wall = [] {
          return Microseconds(CLOCK_REALTIME);
        }});
  }
}

Result<std::unique_ptr<FleetClient>> FleetClient::Create(const FleetOptions& options, int link) {
  std::unique_ptr<FleetClient> client(new FleetClient(options, link));
  LARARIUM_RETURN_IF_ERROR(client->Prepare(options));
  return client;
}

Status FleetClient::Prepare(const FleetOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(client_, MakeClient(options, "lararium", this));
  mosquitto_will_set(client_.get(), topics_.presence.c_str(), sizeof(kOffline) - 1, kOffline,
                     kAtLeastOnce, true);
  mosquitto_connect_callback_set(client_.get(), &Calls::Connected);
  mosquitto_message_callback_set(client_.get(), &Calls::Received);
  mosquitto_log_callback_set(client_.get(), &Calls::Logged);
  mosquitto_max_inflight_messages_set(client_.get(), kUnanswered);
  return Status();
}

void FleetClient::Run() {
  while (true) {
    const int socket = has_socket_ ? mosquitto_socket(client_.get()) : -1;
    const auto wanted = static_cast<short>(
        POLLIN | (has_socket_ && mosquitto_want_write(client_.get()) ? POLLOUT : 0));
    pollfd waiting[] = {{link_, POLLIN, 0}, {socket, wanted, 0}};
    ::poll(waiting, std::size(waiting), relay_ ? kPollInGroupMs : kPollMs);
    if (!TakeMessages()) {
      break;
    }
    if (has_socket_) {
      Serve();
      if (!connected_ && Clock::now() - connecting_since_ > std::chrono::seconds(kConnectSeconds)) {
        Lost("it does not answer");
      }
    } else if (Clock::now() >= next_try_) {
      Connect();
    }
    StepGroup();
    PublishState();
    PublishStatistics();
  }
  if (connected_) {
    PublishPresence(false);
    mosquitto_loop(client_.get(), kPollMs, 1);
    mosquitto_disconnect(client_.get());
    mosquitto_loop(client_.get(), kPollMs, 1);
  }
}

bool FleetClient::TakeMessages() {
  bool open = true;
  while (const auto message = ReceiveStaffMessage(link_, buffer_, open)) {
    if (message->kind == StaffMessage::kState) {
      state_.Set(message->content);
      has_news_ = true;
    } else if (message->kind == StaffMessage::kDays) {
      has_new_statistics_ = has_new_statistics_ || statistics_ != message->content;
      statistics_ = message->content;
    } else if (message->kind == StaffMessage::kGroup && relay_) {
      relay_->TakeOwn(message->content, Microseconds(CLOCK_MONOTONIC));
    }
  }
  return open;
}

// Only the name of the broker's host is waited for; meanwhile the player's messages wait, and those
// that do not fit are dropped.
void FleetClient::Connect() {
  const int code =
      mosquitto_connect_async(client_.get(), broker_.host.c_str(), broker_.port, kKeepAliveSeconds);
  has_socket_ = code == MOSQ_ERR_SUCCESS;
  connecting_since_ = Clock::now();
  if (!has_socket_) {
    Lost(TextOf(code));
  }
}

void FleetClient::Serve() {
  if (const int code = mosquitto_loop(client_.get(), 0, 1);
      code != MOSQ_ERR_SUCCESS && has_socket_) {
    Lost(TextOf(code));
  }
}

void FleetClient::Connected(int code) {
  if (code != 0) {
    Lost(mosquitto_connack_string(code));
    return;
  }
  connected_ = true;
  pause_ = std::chrono::seconds(1);
  if (lost_told_) {
    Note("connected again");
    lost_told_ = false;
  }
  for (const std::string& topic : topics_.commands) {
    mosquitto_subscribe(client_.get(), nullptr, topic.c_str(), kOnce);
  }
  for (const std::vector<std::string>* topics : {&topics_.heard, &topics_.presences}) {
    for (const std::string& topic : *topics) {
      mosquitto_subscribe(client_.get(), nullptr, topic.c_str(), kAtLeastOnce);
    }
  }
  PublishPresence(true);
  published_ = {};
  // The broker may have lost them.
  has_new_statistics_ = !statistics_.empty();
  published_statistics_ = Clock::now() - kBetweenStatistics;
}

void FleetClient::Lost(std::string_view why) {
  has_socket_ = false;
  connected_ = false;
  next_try_ = Clock::now() + pause_;
  pause_ = std::min(2 * pause_, relay_ ? kLongestPauseInGroup : kLongestPause);
  if (!lost_told_) {
    lost_told_ = true;
    const std::string reason = library_says_.empty() ? std::string(why) : library_says_;
    Note("no connection to " + broker_.host + " (" + reason + "); the show goes on");
  }
  library_says_.clear();
}

void FleetClient::Take(const mosquitto_message& message) {
  const std::string_view payload(static_cast<const char*>(message.payload),
                                 static_cast<size_t>(message.payloadlen));
  const std::string_view topic = message.topic;
  if (std::find(topics_.commands.begin(), topics_.commands.end(), topic) ==
      topics_.commands.end()) {
    if (relay_) {
      TakeOfGroup(topic, payload);
    }
    return;
  }
  if (const Status status = gate_.Check(payload, message.retain, Clock::now()); status.ok()) {
    const bool to_all = topic != topics_.commands.front();
    if (!relay_ || !GiveToGroup(payload, to_all)) {
      SendStaffMessage(link_, StaffMessage::kCommand, payload);
    }
  } else if (gate_.tells()) {
    Note(status.message() + "; refused so far: " + std::to_string(gate_.refused()));
  }
}

// A command that concerns the drama is one for the group, if there is a player. Returns false if it
// is one for the player.
bool FleetClient::GiveToGroup(std::string_view payload, bool to_all) {
  using What = group::GroupWish::What;
  const Result<StaffCommand> command = ParseStaffCommand(payload);
  const bool restarts = command.ok() && command->action == Action::kRestart;
  if (!command.ok() || !relay_->member().has_player() ||
      !(restarts || command->hold || !command->go_to.empty())) {
    return false;
  }
  relay_->member().Want(restarts         ? What::kRestart
                        : !command->hold ? What::kGoTo
                        : *command->hold ? What::kHold
                                         : What::kResume,
                        command->go_to, to_all, Microseconds(CLOCK_MONOTONIC));
  return true;
}

namespace {

// The last part of a topic is the name of the member that wrote it, for which the broker vouches.
// Empty: it is no name.
std::string WriterOf(std::string_view topic) {
  const size_t end = topic.rfind('/');
  const std::string_view name = topic.substr(end + 1);
  const bool is_page = topic.substr(0, end + 1).ends_with("/" + std::string(group::kPage));
  return IsFleetName(name) ? (is_page ? std::string(group::kPage) : "") + std::string(name) : "";
}

}  // namespace

void FleetClient::TakeOfGroup(std::string_view topic, std::string_view payload) {
  constexpr std::string_view kPresence = "/presence";
  const bool is_presence = topic.ends_with(kPresence);
  topic.remove_suffix(is_presence ? kPresence.size() : 0);
  const std::string from = WriterOf(topic);
  if (from.empty()) {
    return;
  }
  if (is_presence) {
    if (payload == kOffline) {
      relay_->member().SetGone(from);
    }
    return;
  }
  const Status status = relay_->TakeMessage(from, payload, Microseconds(CLOCK_MONOTONIC));
  // A page may send anything: visitors know its account.
  if (!status.ok() && !group::IsPage(from) && !std::exchange(group_refused_told_, true)) {
    Note(status.message() + " (of \"" + from + "\")");
  }
}

void FleetClient::StepGroup() {
  if (!relay_) {
    return;
  }
  const int64_t now = Microseconds(CLOCK_MONOTONIC);
  relay_->Step(now);
  for (const group::GroupMember::Outgoing& message : relay_->member().TakeOutgoing()) {
    std::string topic = message.to.empty() ? topics_.to_all : topics_.to_one;
    if (!message.to.empty()) {
      topic.replace(topic.find('+'), 1, message.to);
    }
    if (connected_) {  // Members repeat what is lost.
      mosquitto_publish(client_.get(), nullptr, topic.c_str(),
                        static_cast<int>(message.bytes.size()), message.bytes.data(),
                        message.reliable ? kAtLeastOnce : kNewestWins, false);
    }
  }
  for (const std::string& message : relay_->TakeForPlayer(now)) {
    SendStaffMessage(link_, StaffMessage::kGroup, message);
  }
  for (const std::string& note : relay_->member().TakeNotes()) {
    Note(note);
  }
}

void FleetClient::PublishState() {
  const auto passed = Clock::now() - published_;
  const bool due = has_news_ ? passed >= kLeastBetween : passed >= kMostBetween;
  // No state waits in a queue while another one is not sent yet.
  if (!connected_ || !due || mosquitto_want_write(client_.get())) {
    return;
  }
  Json more = {{"name", name_}, {"group", group_}, {"time", std::time(nullptr)}};
  if (relay_) {
    more["drama"] = relay_->State();
  }
  const std::string json = state_.ToJson(std::move(more));
  mosquitto_publish(client_.get(), nullptr, topics_.state.c_str(), static_cast<int>(json.size()),
                    json.data(), kNewestWins, true);
  published_ = Clock::now();
  has_news_ = false;
}

void FleetClient::PublishStatistics() {
  if (!connected_ || !has_new_statistics_ ||
      Clock::now() - published_statistics_ < kBetweenStatistics) {
    return;
  }
  mosquitto_publish(client_.get(), nullptr, topics_.statistics.c_str(),
                    static_cast<int>(statistics_.size()), statistics_.data(), kAtLeastOnce, true);
  published_statistics_ = Clock::now();
  has_new_statistics_ = false;
}

void FleetClient::PublishPresence(bool online) {
  const std::string_view text = online ? kOnline : kOffline;
  mosquitto_publish(client_.get(), nullptr, topics_.presence.c_str(), static_cast<int>(text.size()),
                    text.data(), kAtLeastOnce, true);
}

void FleetClient::Note(const std::string& text) {
  SendStaffMessage(link_, StaffMessage::kNote, text);
}

}  // namespace lararium::player
