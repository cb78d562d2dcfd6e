#include "player/staff/staff_page.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <thread>

#include "player/staff/staff_link.h"
#include "player/staff/staff_texts.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr char kPin[] = "ianua-1738";

// Sends bytes to a server and returns its reply, until it closes the connection or is silent for
// two seconds.
std::string Ask(uint16_t port, const std::string& bytes) {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience = {2, 0};
  ::setsockopt(file, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  ::setsockopt(file, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof(patience));
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(port);
  std::string reply;
  if (::connect(file, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0) {
    (void)!::send(file, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    char buffer[4096];
    for (ssize_t size = 1; size > 0;) {
      size = ::recv(file, buffer, sizeof(buffer), 0);
      reply.append(buffer, static_cast<size_t>(std::max<ssize_t>(size, 0)));
    }
  }
  ::close(file);
  return reply;
}

std::string BodyOf(const std::string& reply) {
  const size_t at = reply.find("\r\n\r\n");
  return at == std::string::npos ? "" : reply.substr(at + 4);
}

// Waits until a condition holds, at most three seconds. Returns whether it holds.
bool Soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 300; ++i) {
    if (holds()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

// A staff page on a free port. The test takes the role of the player.
class StaffPageTest : public ::testing::Test {
 protected:
  void Open(bool with_pin) {
    StaffPageOptions options;
    options.address = {INADDR_LOOPBACK, 0};
    if (with_pin) {
      options.pin_file = folder_ / "pin";
      std::ofstream(options.pin_file) << kPin << "\n";
      ::chmod(options.pin_file.c_str(), 0600);
    }
    auto page = StaffPage::Start(options, *log_);
    ASSERT_TRUE(page.ok()) << page.message();
    page_ = *std::move(page);
  }

  std::string Get(const std::string& path, const std::string& headers = "Host: localhost\r\n") {
    return Ask(page_->port(),
               "GET " + path + " HTTP/1.1\r\n" + headers + "Connection: close\r\n\r\n");
  }
  std::string Post(const std::string& path,
                   const std::string& body,
                   const std::string& headers = "",
                   const std::string& pin = kPin) {
    return Ask(page_->port(), "POST " + path +
                                  " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n"
                                  "Content-Type: application/json\r\nContent-Length: " +
                                  std::to_string(body.size()) + "\r\nX-Staff-Pin: " + pin + "\r\n" +
                                  headers + "\r\n" + body);
  }
  Json State() {
    const auto json = ParseJson(BodyOf(Get("/state.json")), "state");
    return json.ok() ? *json : Json();
  }
  // The player's end of the link, which has sent a state that the page has received.
  StaffLink& Player() {
    if (!player_) {
      player_.emplace(StaffLinks{.page = page_->link()}, *log_);
      StaffState state;
      state.title = "The <thermopolium>";
      state.languages = {"la", "it"};
      player_->Tell(state);
      EXPECT_TRUE(Soon([&] { return State()["answers"] == true; }));
    }
    return *player_;
  }
  std::vector<StaffCommand> Commands() {
    std::vector<StaffCommand> commands;
    Soon([&] {
      commands = Player().TakeCommands();
      return !commands.empty();
    });
    return commands;
  }

  test::TemporaryFolder folder_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<StaffPage> page_;
  std::optional<StaffLink> player_;
};

TEST_F(StaffPageTest, ShowsWhatThePlayerSays) {
  Open(false);
  EXPECT_EQ(State()["answers"], false) << "it has said nothing yet";
  EXPECT_EQ(State()["player"], Json());
  StaffState state;
  state.title = "Vetutius";
  state.place = "thermopolium";
  state.tracking = vision::TrackState::kLost;
  state.reason = vision::TrackReason::kTooDark;
  state.lost_seconds = 7.5;
  state.tracked_minute = 0.25;
  state.visitor = true;
  state.restarts = 3;
  log_->Error("the camera\nis gone");
  Player().Tell(state);
  log_->Warn("\"quoted\" \xff");
  ASSERT_TRUE(Soon([&] { return State()["player"]["title"] == "Vetutius"; }));
  Player().Tell(state);
  ASSERT_TRUE(Soon([&] { return State()["player"]["warnings"].size() == 2; }));
  const Json player = State()["player"];
  EXPECT_EQ(player["warnings"][0]["text"], "the camera");
  EXPECT_EQ(player["tracking"]["state"], "lost");
  EXPECT_EQ(player["tracking"]["reason"], "too dark");
  EXPECT_EQ(player["tracking"]["lost_seconds"], 7.5);
  EXPECT_EQ(player["tracking"]["tracked_minute"], 0.25);
  EXPECT_EQ(player["visitor"], true);
  EXPECT_EQ(player["restarts"], 3);
  EXPECT_EQ(player["length"], Json());
  EXPECT_GT(player["memory_mib"], 1.0);
}

TEST_F(StaffPageTest, SaysWhereThePlayerHasFallenSilent) {
  Open(false);
  Player();
  player_.reset();
  EXPECT_TRUE(Soon([&] { return State()["silent_seconds"] > 1.0; }));
  EXPECT_EQ(State()["player"]["title"], "The <thermopolium>") << "what it said last";
}

TEST_F(StaffPageTest, IsOnePageInTheReadersLanguageThatNeedsNothingFromElsewhere) {
  Open(false);
  const std::string page = Get("/", "Host: localhost\r\nAccept-Language: de, it-IT;q=0.8\r\n");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("lang=\"it\""));
  EXPECT_THAT(page, HasSubstr("Ritrova il luogo"));
  EXPECT_THAT(Get("/"), HasSubstr("Find the place again"));
  for (const char* path : {"/", "/page.css", "/page.js", "/parts.js"}) {
    const std::string reply = Get(path);
    EXPECT_THAT(reply, HasSubstr("Content-Security-Policy: default-src 'none'")) << path;
    EXPECT_THAT(reply, HasSubstr("X-Content-Type-Options: nosniff")) << path;
    EXPECT_THAT(reply, Not(HasSubstr("Access-Control"))) << path;
    EXPECT_THAT(BodyOf(reply), Not(HasSubstr("http:"))) << path;
    EXPECT_THAT(BodyOf(reply), Not(HasSubstr("https:"))) << path;
    EXPECT_THAT(BodyOf(reply), Not(HasSubstr("{{"))) << path;
  }
}

TEST_F(StaffPageTest, WithoutAPinNothingIsDone) {
  Open(false);
  EXPECT_EQ(State()["pin"]["set"], false);
  Player();
  for (const char* pin : {"", "123456", kPin}) {
    EXPECT_THAT(Post("/command", R"({"do":"restart"})", "", pin), StartsWith("HTTP/1.1 403"));
  }
  EXPECT_TRUE(Player().TakeCommands().empty());
}

TEST_F(StaffPageTest, WithThePinCommandsReachThePlayerInTheirOrder) {
  Open(true);
  EXPECT_EQ(State()["pin"]["set"], true);
  Player();
  EXPECT_THAT(Post("/pin", ""), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(Post("/command", R"({"do":"restart"})"), StartsWith("HTTP/1.1 202"));
  StaffCommand restart;
  restart.action = Action::kRestart;
  EXPECT_THAT(Commands(), ::testing::ElementsAre(restart));
  EXPECT_THAT(Post("/command", R"({"do":"language","value":"it"})"), StartsWith("HTTP/1.1 202"));
  EXPECT_THAT(Post("/command", R"({"do":"begin_again"})"), StartsWith("HTTP/1.1 202"));
  std::vector<StaffCommand> both;
  Soon([&] {
    for (StaffCommand& command : Player().TakeCommands()) {
      both.push_back(std::move(command));
    }
    return both.size() == 2;
  });
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].language, "it");
  EXPECT_TRUE(both[1].begin_again);
}

TEST(StaffCommand, TakesWhatMakesAShowEasierToFollow) {
  const auto parse = [](const char* text) { return ParseStaffCommand(text); };
  EXPECT_EQ(parse(R"({"do":"caption_size","value":"large"})")->caption_size,
            render::CaptionSize::kLarge);
  EXPECT_EQ(parse(R"({"do":"caption_contrast","value":"high"})")->caption_contrast,
            render::CaptionContrast::kHigh);
  EXPECT_EQ(parse(R"({"do":"descriptions","value":true})")->descriptions, true);
  EXPECT_EQ(parse(R"({"do":"reduced_motion","value":false})")->reduced_motion, false);
  for (const char* text : {R"({"do":"caption_size"})", R"({"do":"caption_size","value":"huge"})",
                           R"({"do":"descriptions","value":"on"})", R"({"do":"reduced_motion"})"}) {
    EXPECT_FALSE(parse(text).ok()) << text;
  }
}

TEST(StaffCommand, HoldsADramaLetsItGoOnAndGoesToAMarker) {
  EXPECT_EQ(ParseStaffCommand(R"({"do":"hold"})")->hold, true);
  EXPECT_EQ(ParseStaffCommand(R"({"do":"resume"})")->hold, false);
  EXPECT_EQ(ParseStaffCommand(R"({"do":"go_to","value":"noon"})")->go_to, "noon");
  EXPECT_FALSE(ParseStaffCommand(R"({"do":"go_to"})").ok());
  EXPECT_FALSE(ParseStaffCommand(R"({"do":"go_to","value":""})").ok());
}

TEST(StaffCommand, ChangesWhatItIsAboutAndNothingThatAVisitorChose) {
  const std::vector<std::string> spoken = {"la"};
  const std::vector<std::string> captions = {"en", "it"};
  const Offer offer = {spoken, captions, true};
  const auto choose = [&offer](const char* command, Choices& choices) {
    Choose(*ParseStaffCommand(command), offer, choices);
  };
  const Choices before = {
      "la", "en", 0.5, {render::CaptionSize::kLarge, render::CaptionContrast::kHigh}, true, true};
  Choices choices = before;
  choose(R"({"do": "volume", "value": 0.8})", choices);
  EXPECT_EQ(choices.volume, 0.8);
  choices.volume = before.volume;
  EXPECT_EQ(choices, before);
  choose(R"({"do": "language", "value": "de"})", choices);
  choose(R"({"do": "captions", "value": "la"})", choices);
  EXPECT_EQ(choices, before) << "the show has neither";
  choose(R"({"do": "captions", "value": "off"})", choices);
  EXPECT_EQ(choices.captions, "off");
  choose(R"({"do": "captions", "value": "it"})", choices);
  EXPECT_EQ(choices.captions, "it");
}

TEST_F(StaffPageTest, WhatIsNoCommandIsRefusedAndSaysWhy) {
  Open(true);
  Player();
  for (const char* body : {"", "{", "[]", R"({"do":"format"})", R"({"do":"volume"})",
                           R"({"do":"volume","value":7})", R"({"do":1})"}) {
    EXPECT_THAT(Post("/command", body), StartsWith("HTTP/1.1 400")) << body;
  }
  EXPECT_THAT(Ask(page_->port(), std::string("POST /command HTTP/1.1\r\nHost: localhost\r\n"
                                             "Connection: close\r\nContent-Length: 2\r\n"
                                             "X-Staff-Pin: ") +
                                     kPin + "\r\n\r\n{}"),
              StartsWith("HTTP/1.1 415"));
  EXPECT_TRUE(Player().TakeCommands().empty());
}

TEST_F(StaffPageTest, WrongPinsAreLockedOutAndTheRightOneWithThem) {
  Open(true);
  Player();
  for (int i = 1; i < PinLock::kFreeTries; ++i) {
    EXPECT_THAT(Post("/command", R"({"do":"end"})", "", "123456"), StartsWith("HTTP/1.1 401"));
  }
  EXPECT_THAT(Post("/pin", "", "", "123456"), StartsWith("HTTP/1.1 429"));
  EXPECT_THAT(Post("/pin", ""), HasSubstr("Retry-After: "));
  EXPECT_THAT(Post("/command", R"({"do":"end"})"), StartsWith("HTTP/1.1 429"));
  EXPECT_GT(State()["pin"]["locked_seconds"], 50.0);
  EXPECT_TRUE(Player().TakeCommands().empty());
  Player().Tell({});
  EXPECT_TRUE(Soon([&] { return State()["player"]["warnings"].size() == 5; }))
      << "the log hears of each";
}

TEST_F(StaffPageTest, StrangersPagesAreRefused) {
  Open(true);
  Player();
  for (const char* host : {"evil.example", "evil.example:80", "localhost.evil.example", ""}) {
    EXPECT_THAT(Get("/state.json", std::string("Host: ") + host + "\r\n"),
                StartsWith("HTTP/1.1 421"))
        << host;
  }
  for (const char* host : {"127.0.0.1", "192.168.1.5:8090", "localhost:1", "[::1]:80"}) {
    EXPECT_THAT(Get("/state.json", std::string("Host: ") + host + "\r\n"),
                StartsWith("HTTP/1.1 200"))
        << host;
  }
  EXPECT_THAT(Post("/command", R"({"do":"end"})", "Origin: http://evil.example\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Post("/command", R"({"do":"end"})", "Origin: null\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_TRUE(Player().TakeCommands().empty());
  EXPECT_THAT(Post("/command", R"({"do":"end"})", "Origin: http://localhost\r\n"),
              StartsWith("HTTP/1.1 202"));
}

TEST_F(StaffPageTest, OtherAddressesAndMethodsAreRefused) {
  Open(true);
  for (const char* path :
       {"/index.html", "/../etc/passwd", "/%2e%2e/etc/passwd", "//", "/page.js/"}) {
    EXPECT_THAT(Get(path), StartsWith("HTTP/1.1 404")) << path;
  }
  EXPECT_THAT(Get("/command"), StartsWith("HTTP/1.1 405"));
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "EAD"}) {
    const std::string reply =
        Ask(page_->port(), std::string(method) +
                               " /state.json HTTP/1.1\r\nHost: localhost\r\n"
                               "Connection: close\r\nContent-Length: 0\r\n\r\n");
    EXPECT_THAT(reply, StartsWith("HTTP/1.1 405")) << method;
    EXPECT_THAT(reply, HasSubstr("Allow: GET, HEAD")) << method;
  }
}

TEST_F(StaffPageTest, GarbageAndTooMuchDoNoHarm) {
  Open(true);
  EXPECT_THAT(Post("/command", std::string(1025, 'x')), StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(Get("/" + std::string(40'000, 'a')), StartsWith("HTTP/1.1 4"));
  EXPECT_THAT(Get("/", "Host: localhost\r\nX: " + std::string(40'000, 'a') + "\r\n"),
              StartsWith("HTTP/1.1 4"));
  const std::string head = "POST /command HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n";
  for (const std::string& bytes :
       {std::string("\0\1\2\3\r\n\r\n", 8), std::string("GET\r\n\r\n"),
        std::string("GET / HTTP/9.9\r\n\r\n"), std::string(3000, '\xff') + "\r\n\r\n",
        head + "Content-Length: -1\r\n\r\n",
        head + "Content-Length: 99999999999999999999999\r\n\r\n",
        head + "Transfer-Encoding: chunked\r\n\r\nzz\r\n",
        head + "Transfer-Encoding: chunked\r\n\r\n401\r\n" + std::string(1025, 'x') +
            "\r\n0\r\n\r\n"}) {
    EXPECT_THAT(Ask(page_->port(), bytes), Not(StartsWith("HTTP/1.1 2"))) << bytes.substr(0, 40);
  }
  std::vector<std::thread> crowd;
  for (int i = 0; i < 40; ++i) {
    crowd.emplace_back([this] { Get("/"); });
  }
  for (std::thread& visitor : crowd) {
    visitor.join();
  }
  EXPECT_THAT(Get("/"), StartsWith("HTTP/1.1 200")) << "it is as it was";
  EXPECT_EQ(::waitpid(page_->process(), nullptr, WNOHANG), 0) << "and runs";
}

TEST_F(StaffPageTest, APictureIsMadeOnlyForWhoAsks) {
  Open(false);
  EXPECT_FALSE(Player().PictureWanted(StaffLink::Now()));
  EXPECT_THAT(Get("/mirror.jpg"), StartsWith("HTTP/1.1 503"));
  ASSERT_TRUE(Soon([&] { return Player().PictureWanted(StaffLink::Now()); }));
  EXPECT_FALSE(Player().PictureWanted(StaffLink::Now() + 6.0)) << "not for long";
  Player().Show(cv::Mat(180, 320, CV_8UC4, cv::Scalar(200, 100, 50, 255)));
  ASSERT_TRUE(Soon([&] { return Get("/mirror.jpg").starts_with("HTTP/1.1 200"); }));
  const std::string reply = Get("/mirror.jpg");
  EXPECT_THAT(reply, HasSubstr("Content-Type: image/jpeg"));
  const std::string jpeg = BodyOf(reply);
  const cv::Mat picture =
      cv::imdecode(std::vector<unsigned char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.size(), cv::Size(320, 180));
  EXPECT_NEAR(picture.at<cv::Vec3b>(90, 160)[0], 50, 4) << "blue";
  EXPECT_NEAR(picture.at<cv::Vec3b>(90, 160)[2], 200, 4) << "red";
}

TEST_F(StaffPageTest, DaysAreATableWhereTheyAreCounted) {
  Open(false);
  EXPECT_THAT(Get("/statistics.csv"), StartsWith("HTTP/1.1 404"));
  VisitStatistics statistics;
  statistics.Day("2026-11-23").visitors = 12;
  Player().TellStatistics(statistics);
  ASSERT_TRUE(Soon([&] { return Get("/statistics.csv").starts_with("HTTP/1.1 200"); }));
  EXPECT_EQ(BodyOf(Get("/statistics.csv")), statistics.ToCsv());
}

TEST_F(StaffPageTest, ATakenPortIsOneClearError) {
  Open(false);
  const auto second = StaffPage::Start({{INADDR_LOOPBACK, page_->port()}, {}, true}, *log_);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.message(), HasSubstr("another program listens there"));
  EXPECT_THAT(second.message(), HasSubstr("--staff-page"));
}

TEST_F(StaffPageTest, ItsProcessGoesWithThePlayer) {
  Open(false);
  const uint16_t port = page_->port();
  EXPECT_NE(Get("/"), "");
  page_.reset();
  EXPECT_EQ(Ask(port, "GET / HTTP/1.0\r\n\r\n"), "") << "nobody listens";
}

TEST_F(StaffPageTest, ThePlayerGoesOnWithoutIt) {
  Open(false);
  Player();
  ::kill(page_->process(), SIGKILL);
  for (int i = 0; i < 50; ++i) {
    Player().Tell({});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(Player().TakeCommands().empty());
}

TEST(StaffTexts, ALanguageThatThePageLacksIsEnglish) {
  EXPECT_EQ(StaffLanguage(""), "en");
  EXPECT_EQ(StaffLanguage("de-AT, fr"), "en");
  EXPECT_EQ(StaffLanguage("it"), "it");
  EXPECT_EQ(StaffLanguage("en;q=0.5, it;q=0.7"), "it");
  EXPECT_EQ(StaffLanguage("it;q=nonsense,,;;q=,en"), "en");
}

}  // namespace
}  // namespace lararium::player
