// The link to a fleet over a real broker, which starts from exactly what fleet-setup writes.

#include "player/fleet/fleet_link.h"

#include <gmock/gmock.h>
#include <mosquitto.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "player/app/device_file.h"
#include "player/fleet/fleet_client.h"
#include "player/fleet/fleet_setup.h"
#include "player/staff/staff_link.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "tests/player/test_broker.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using test::FreePort;
using test::Soon;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kState[] = "lararium/pompeii/device/tablet-01/state";
constexpr char kPresence[] = "lararium/pompeii/device/tablet-01/presence";
constexpr char kStatistics[] = "lararium/pompeii/device/tablet-01/statistics";
constexpr char kCommands[] = "lararium/pompeii/device/tablet-01/do";
constexpr char kRestart[] = R"({"do": "restart"})";

// A client of the broker with any account. It keeps the last message of each topic.
class Client {
 public:
  Client(const FleetOptions& options, const std::string& user)
      : client_(mosquitto_new(("test-" + user).c_str(), true, this)) {
    const FleetAddress broker = options.broker();
    if (!options.password.empty()) {
      const std::string password = ReadText(options.password).value();
      mosquitto_username_pw_set(client_, user.c_str(),
                                password.substr(0, password.find('\n')).c_str());
    }
    const auto name = [](const std::filesystem::path& p) {
      return p.empty() ? nullptr : p.c_str();
    };
    mosquitto_tls_set(client_, options.authority.c_str(), nullptr, name(options.certificate),
                      name(options.key), nullptr);
    mosquitto_message_callback_set(client_, &Received);
    mosquitto_subscribe_callback_set(client_, &Subscribed);
    EXPECT_EQ(mosquitto_connect(client_, broker.host.c_str(), broker.port, 10), MOSQ_ERR_SUCCESS);
    mosquitto_loop_start(client_);
  }
  ~Client() {
    mosquitto_disconnect(client_);
    mosquitto_loop_stop(client_, true);
    mosquitto_destroy(client_);
  }

  void Subscribe(const std::string& topic) {
    subscribed_ = false;
    mosquitto_subscribe(client_, nullptr, topic.c_str(), 1);
    EXPECT_TRUE(Soon([this] { return subscribed_.load(); })) << topic;
  }
  void Publish(const std::string& topic, const std::string& text, bool keep = false) {
    mosquitto_publish(client_, nullptr, topic.c_str(), static_cast<int>(text.size()), text.data(),
                      1, keep);
  }
  // The last message of a topic; null: there is none.
  Json Last(const std::string& topic) {
    const std::lock_guard lock(mutex_);
    const auto found = messages_.find(topic);
    return found == messages_.end() ? Json() : ParseJson(found->second, topic).value();
  }
  std::string Text(const std::string& topic) {
    const std::lock_guard lock(mutex_);
    return messages_[topic];
  }

 private:
  static void Received(mosquitto* /*client*/, void* self, const mosquitto_message* message) {
    auto& client = *static_cast<Client*>(self);
    const std::lock_guard lock(client.mutex_);
    client.messages_[message->topic] = std::string(static_cast<const char*>(message->payload),
                                                   static_cast<size_t>(message->payloadlen));
  }
  static void Subscribed(mosquitto* /*client*/, void* self, int /*id*/, int, const int*) {
    static_cast<Client*>(self)->subscribed_ = true;
  }

  mosquitto* client_;
  std::atomic<bool> subscribed_ = false;
  std::mutex mutex_;
  std::map<std::string, std::string> messages_;
};

// A broker with two devices. The test takes the role of the first one's player.
class FleetLinkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::TestBroker::installed()) {
      GTEST_SKIP() << "needs Debian's package mosquitto";
    }
    mosquitto_lib_init();
    port_ = FreePort();
    setup_.folder = folder_ / "fleet";
    setup_.host = "127.0.0.1";
    setup_.site = "pompeii";
    setup_.port = port_;
    setup_.page_port = FreePort();
    setup_.broker_folder = (setup_.folder / "broker").string();
    setup_.devices = {"tablet-01:red", "tablet-02:blue"};
  }
  void TearDown() override {
    staff_.reset();
    player_.reset();
    link_.reset();
    KillBroker();
    mosquitto_lib_cleanup();
  }

  void SetUpAndStart() {
    const auto done = SetUpFleet(setup_);
    ASSERT_TRUE(done.ok()) << done.message();
    StartBroker();
  }
  void StartBroker() { broker_.Start(setup_.broker_folder, port_); }
  void KillBroker() { broker_.Kill(); }
  std::string BrokerLog() { return broker_.log(); }

  FleetOptions StaffAccount() {
    FleetOptions staff = Device("tablet-01");
    staff.password = setup_.folder / "staff.password";
    return staff;
  }
  FleetOptions Device(const std::string& name) {
    return *LoadDevice(setup_.folder / "devices" / name / "device.json")->fleet;
  }
  // Starts the link of the first device and then the client of the staff, whose thread a fork
  // would not have.
  void Join() {
    StartLink(Device("tablet-01"));
    staff_.emplace(StaffAccount(), "staff");
    staff_->Subscribe("lararium/pompeii/#");
  }
  void StartLink(const FleetOptions& options) {
    auto link = FleetLink::Start(options, true, *log_);
    ASSERT_TRUE(link.ok()) << link.message();
    link_ = *std::move(link);
    player_.emplace(StaffLinks{.fleet = link_->link()}, *log_);
  }

  void Tell(const std::string& title) {
    StaffState state;
    state.title = title;
    player_->Tell(state);
  }
  // Waits until the staff sees a title, which the player tells again and again.
  bool StaffSees(const std::string& title) {
    return Soon([&] {
      Tell(title);
      const Json state = staff_->Last(kState);
      return state.is_object() && state["answers"] == true && state["player"]["title"] == title;
    });
  }
  bool StaffSeesOnline(bool online) {
    return Soon([&] {
      const Json presence = staff_->Last(kPresence);
      return presence.is_object() && presence["online"] == online;
    });
  }
  std::vector<StaffCommand> Commands() {
    std::vector<StaffCommand> commands;
    Soon([&] {
      commands = player_->TakeCommands();
      return !commands.empty();
    });
    return commands;
  }
  std::vector<std::string> Warnings() {
    std::vector<std::string> texts;
    for (const RecentWarnings::Entry& entry : RecentWarnings::Of(*log_)->Entries()) {
      texts.push_back(entry.text);
    }
    return texts;
  }

  test::TemporaryFolder folder_;
  FleetSetupOptions setup_;
  uint16_t port_ = 0;
  test::TestBroker broker_{folder_.path()};
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<FleetLink> link_;
  std::optional<StaffLink> player_;
  std::optional<Client> staff_;
};

TEST_F(FleetLinkTest, StateAndPresenceAreKeptForThoseWhoComeLater) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  EXPECT_TRUE(StaffSeesOnline(true));
  const Json state = staff_->Last(kState);
  EXPECT_EQ(state["name"], "tablet-01");
  EXPECT_EQ(state["group"], "red");
  EXPECT_EQ(state["schema"], 1);
  EXPECT_GT(state["time"], 1'700'000'000);
  EXPECT_EQ(state["player"]["visitor"], Json());
  staff_.reset();
  Client later(StaffAccount(), "staff");
  later.Subscribe("lararium/pompeii/#");
  EXPECT_TRUE(Soon([&] { return later.Text(kState) != "" && later.Text(kPresence) != ""; }));
}

TEST_F(FleetLinkTest, StatisticsAreKeptWithoutSmallCountsAndPublishedOnceInFiveMinutes) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  VisitStatistics statistics;
  statistics.Day("2026-11-23").visitors = 12;
  statistics.Day("2026-11-23").details = VisitDetails{.ended = {9, 11}};
  player_->TellStatistics(statistics);
  EXPECT_TRUE(Soon([&] { return staff_->Text(kStatistics) != ""; }));
  EXPECT_EQ(staff_->Last(kStatistics)["days"][0]["ended"], Json({0, 11}));
  const std::string published = staff_->Text(kStatistics);
  EXPECT_EQ(published, PublishedStatistics(statistics));
  statistics.Day("2026-11-23").visitors = 13;
  player_->TellStatistics(statistics);
  ASSERT_TRUE(StaffSees("later"));
  EXPECT_EQ(staff_->Text(kStatistics), published);
  KillBroker();
  StartBroker();
  staff_.emplace(StaffAccount(), "staff");
  staff_->Subscribe("lararium/pompeii/#");
  EXPECT_TRUE(Soon([&] { return staff_->Text(kStatistics) == PublishedStatistics(statistics); }))
      << "a broker that comes back is told at once";
}

TEST_F(FleetLinkTest, APlayerThatFallsSilentIsSeenToBeSo) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  EXPECT_TRUE(Soon([&] { return staff_->Last(kState)["answers"] == false; }));
  EXPECT_EQ(staff_->Last(kState)["player"]["title"], "Vetutius");
}

TEST_F(FleetLinkTest, CommandsForTheDeviceAndForItsGroupReachThePlayerOnce) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  StaffCommand restart;
  restart.action = Action::kRestart;
  staff_->Publish("lararium/pompeii/device/tablet-02/do", R"({"do": "end"})");
  staff_->Publish("lararium/pompeii/group/blue/do", R"({"do": "end"})");
  staff_->Publish(kCommands, kRestart);
  EXPECT_THAT(Commands(), ElementsAre(restart));
  staff_->Publish("lararium/pompeii/group/red/do", R"({"do": "language", "value": "it"})");
  const std::vector<StaffCommand> commands = Commands();
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(commands[0].language, "it");
  EXPECT_THAT(Warnings(), IsEmpty());
}

TEST_F(FleetLinkTest, WhatIsMalformedHugeOrKeptIsOneWarningAndNothingElse) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("\0\xff", 2), std::string(60'000, 'x'),
        R"({"do": "end")" + std::string(2000, ' ') + "}", std::string(R"({"do": "volume"})")}) {
    staff_->Publish(kCommands, text);
  }
  staff_->Publish(kCommands, kRestart);
  EXPECT_EQ(Commands().size(), 1u) << "the good one came behind the others";
  ASSERT_THAT(Warnings(), ElementsAre(HasSubstr("command of the fleet")));
}

TEST_F(FleetLinkTest, ACommandThatTheBrokerKeptIsNotObeyedAgain) {
  SetUpAndStart();
  {
    Client before(StaffAccount(), "staff");
    before.Subscribe(kState);
    before.Publish(kCommands, R"({"do": "end"})", true);
    before.Publish("lararium/pompeii/group/red/do", R"({"do": "end"})", true);
    before.Subscribe(kPresence);  // The broker has the commands when it answers.
  }
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  EXPECT_TRUE(Soon([&] { return !Warnings().empty(); }));
  EXPECT_THAT(Warnings(), ElementsAre(HasSubstr("kept it from earlier")));
  EXPECT_THAT(player_->TakeCommands(), IsEmpty());
}

TEST_F(FleetLinkTest, TheLastWillTellsOfADeviceThatIsGoneAndTheEndOfOneThatLeaves) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  ASSERT_TRUE(StaffSeesOnline(true));
  ::kill(link_->process(), SIGKILL);
  EXPECT_TRUE(StaffSeesOnline(false));
  EXPECT_TRUE(Soon([&] { return !Warnings().empty(); }));
  EXPECT_THAT(Warnings(), ElementsAre(HasSubstr("the process of the fleet ended")));
}

TEST_F(FleetLinkTest, ADeviceThatLeavesSaysSo) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  ASSERT_TRUE(StaffSeesOnline(true));
  player_.reset();
  link_.reset();
  EXPECT_TRUE(StaffSeesOnline(false));
}

TEST_F(FleetLinkTest, ConnectsAgainWhenTheBrokerIsBack) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  KillBroker();
  EXPECT_TRUE(Soon([&] {
    Tell("goes on");
    return !Warnings().empty();
  }));
  EXPECT_THAT(Warnings(), ElementsAre(HasSubstr("no connection to 127.0.0.1")));
  StartBroker();
  staff_.emplace(StaffAccount(), "staff");
  staff_->Subscribe("lararium/pompeii/#");
  EXPECT_TRUE(StaffSees("is back"));
  staff_->Publish(kCommands, kRestart);
  EXPECT_EQ(Commands().size(), 1u);
}

TEST_F(FleetLinkTest, NoDeviceWritesOrReadsWhatBelongsToAnother) {
  SetUpAndStart();
  Join();
  ASSERT_TRUE(StaffSees("Vetutius"));
  Client other(Device("tablet-02"), "tablet-02");
  other.Subscribe("lararium/pompeii/#");
  other.Publish(kState, R"({"forged": true})", true);
  other.Publish(kPresence, R"({"forged": true})", true);
  other.Publish(kCommands, kRestart);
  other.Publish("lararium/pompeii/device/tablet-02/state", R"({"own": true})", true);
  EXPECT_TRUE(Soon([&] {
    return staff_->Text("lararium/pompeii/device/tablet-02/state") == R"({"own": true})";
  })) << "it came behind the forged ones";
  staff_->Publish(kCommands, R"({"do": "louder"})");
  staff_->Publish("lararium/pompeii/device/tablet-02/do", kRestart);
  EXPECT_TRUE(Soon([&] { return other.Text("lararium/pompeii/device/tablet-02/do") != ""; }));
  EXPECT_EQ(other.Text(kState), "");
  EXPECT_EQ(other.Text(kCommands), "");
  EXPECT_EQ(staff_->Text(kState).find("forged"), std::string::npos);
  EXPECT_EQ(staff_->Text(kPresence).find("forged"), std::string::npos);
  const std::vector<StaffCommand> commands = Commands();
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(commands[0].action, Action::kLouder);
}

TEST_F(FleetLinkTest, ABrokerThatRefusesThePasswordIsNamedInOneWarning) {
  SetUpAndStart();
  const FleetOptions options = Device("tablet-01");
  std::ofstream(options.password) << "wrong\n";
  StartLink(options);
  ASSERT_TRUE(Soon([&] { return !Warnings().empty(); }));
  EXPECT_THAT(Warnings(), ElementsAre(HasSubstr("not authorised")));
}

TEST_F(FleetLinkTest, ABrokerWithACertificateOfOthersIsNotTrusted) {
  SetUpAndStart();
  FleetSetupOptions other = setup_;
  other.folder = folder_ / "other";
  ASSERT_TRUE(SetUpFleet(other).ok());
  FleetOptions options = Device("tablet-01");
  options.authority = other.folder / "authority.crt";
  StartLink(options);
  ASSERT_TRUE(Soon([&] { return !Warnings().empty(); }));
  EXPECT_THAT(Warnings(), ElementsAre(HasSubstr("certificate verify failed")));
}

TEST_F(FleetLinkTest, TheDoctorConnectsOnceAndSaysWhyThatFails) {
  SetUpAndStart();
  const FleetOptions options = Device("tablet-01");
  EXPECT_TRUE(TryFleet(options).ok()) << TryFleet(options).message();
  std::ofstream(options.password) << "wrong\n";
  EXPECT_THAT(TryFleet(options).message(), HasSubstr("not authorised"));
  KillBroker();
  EXPECT_THAT(TryFleet(options).message(), HasSubstr("refused"));
}

TEST_F(FleetLinkTest, DevicesMayProveTheirNamesByCertificates) {
  setup_.certificates = true;
  SetUpAndStart();
  StartLink(Device("tablet-01"));
  Client other(Device("tablet-02"), "tablet-02");
  other.Subscribe("lararium/pompeii/#");
  // Only the staff may read the state, and its account has a password; the broker's log names
  // users.
  std::string log;
  EXPECT_TRUE(Soon([&] {
    Tell("Vetutius");
    log = BrokerLog();
    return log.find("u'tablet-01'") != std::string::npos;
  })) << log;
  EXPECT_THAT(Warnings(), IsEmpty());
}

}  // namespace
}  // namespace lararium::player
