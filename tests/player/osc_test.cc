#include "player/app/osc.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <lo/lo.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <limits>

namespace lararium::player {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A message encoded by liblo.
template <typename... Arguments>
std::vector<std::byte> Packet(const char* address, const char* types, Arguments... arguments) {
  lo_message message = lo_message_new();
  if (*types != 0) {
    lo_message_add_internal(message, __FILE__, __LINE__, types, arguments..., LO_ARGS_END);
  }
  size_t size = 0;
  void* data = lo_message_serialise(message, address, nullptr, &size);
  const auto* bytes = static_cast<const std::byte*>(data);
  std::vector<std::byte> packet(bytes, bytes + size);
  free(data);
  lo_message_free(message);
  return packet;
}

std::vector<std::byte> Bundle(const std::vector<std::vector<std::byte>>& elements) {
  std::vector<std::byte> packet(16);
  std::memcpy(packet.data(), "#bundle", 8);
  for (const std::vector<std::byte>& element : elements) {
    const uint32_t size = htonl(static_cast<uint32_t>(element.size()));
    const auto* bytes = reinterpret_cast<const std::byte*>(&size);
    packet.insert(packet.end(), bytes, bytes + 4);
    packet.insert(packet.end(), element.begin(), element.end());
  }
  return packet;
}

std::vector<std::string> Parsed(const std::vector<std::byte>& packet) {
  const auto words = ParseOsc(packet);
  EXPECT_TRUE(words.ok()) << words.message();
  return words.ok() ? *words : std::vector<std::string>();
}

std::string Refusal(const std::vector<std::byte>& packet) {
  const auto words = ParseOsc(packet);
  return words.ok() ? "" : words.message();
}

TEST(Osc, MessagesBecomeWordsWithTheirArguments) {
  EXPECT_THAT(Parsed(Packet("/door/open", "")), ElementsAre("/door/open"));
  EXPECT_THAT(Parsed(Packet("/a", "ifd", 3, 0.1, -2.5)), ElementsAre("/a,3,0.1,-2.5"));
  EXPECT_THAT(Parsed(Packet("/a", "s", "ecce, vīnum\n")),
              ElementsAre("/a,'ecce%2C%20v%C4%ABnum%0A"));
  EXPECT_THAT(Parsed(Packet("/a", "TFN")), ElementsAre("/a,T,F,N"));
  EXPECT_THAT(Parsed(Packet("/a", "h", int64_t{1} << 40)), ElementsAre("/a,1099511627776"));
}

TEST(Osc, BundlesAreTakenApartInTheirOrder) {
  const auto packet = Bundle({Packet("/a", "i", 1), Bundle({Packet("/b", ""), Packet("/c", "")})});
  EXPECT_THAT(Parsed(packet), ElementsAre("/a,1", "/b", "/c"));
  EXPECT_THAT(Parsed(Bundle({})), IsEmpty());
}

TEST(Osc, WhatIsNotAsOscSaysIsRefusedAsAWhole) {
  EXPECT_THAT(Refusal({}), HasSubstr("not a valid message"));
  EXPECT_THAT(Refusal(std::vector<std::byte>(4)), HasSubstr("not a valid message"));
  EXPECT_THAT(Refusal(std::vector<std::byte>(64, std::byte{'/'})),
              HasSubstr("not a valid message"));
  EXPECT_THAT(Refusal(Packet("/a b", "")), HasSubstr("not a valid message"));
  EXPECT_THAT(Refusal(Packet("/a,1", "")), HasSubstr("not a valid message"));
  EXPECT_THAT(Refusal(Packet("/a\n0 1", "")), HasSubstr("not a valid message"))
      << "a line of a log";
  EXPECT_THAT(Refusal(Packet("/a", "iiiiiiiii", 1, 2, 3, 4, 5, 6, 7, 8, 9)),
              HasSubstr("more than 8"));
  EXPECT_THAT(Refusal(Packet("/a", "s", std::string(500, 'a').c_str())), HasSubstr("400 bytes"));
  EXPECT_THAT(Refusal(Packet("/a", "f", std::numeric_limits<double>::infinity())),
              HasSubstr("not finite"));
  EXPECT_THAT(Refusal(Packet("/a", "c", 'x')), HasSubstr("an unsupported type"));
  std::vector<std::byte> cut = Packet("/a", "ii", 1, 2);
  cut.resize(cut.size() - 4);
  EXPECT_THAT(Refusal(cut), HasSubstr("do not match its types"));
  std::vector<std::byte> bundle = Bundle({Packet("/a", ""), Packet("/b", "")});
  bundle.pop_back();
  EXPECT_THAT(Refusal(bundle), HasSubstr("is cut off"));
  std::vector<std::byte> deep = Packet("/a", "");
  for (int i = 0; i < 5; ++i) {
    deep = Bundle({deep});
  }
  EXPECT_THAT(Refusal(deep), HasSubstr("too deeply"));
}

TEST(Osc, EveryCutAndEveryChangedByteEndsWell) {
  const auto packet = Bundle({Packet("/door/open", "ifs", 1, 0.5, "oak"), Packet("/b", "TN")});
  for (size_t i = 0; i < packet.size(); ++i) {
    (void)ParseOsc(std::span(packet).first(i)).ok();
    for (const int value : {0, 1, 0x7f, 0xff}) {
      std::vector<std::byte> changed = packet;
      changed[i] = static_cast<std::byte>(value);
      const auto words = ParseOsc(changed);
      for (const std::string& word : words.ok() ? *words : std::vector<std::string>()) {
        EXPECT_EQ(word.find_first_of(" \n\t"), std::string::npos);
      }
    }
  }
}

TEST(ListenAddress, NamesAPortOfThisMachineOrOfANetwork) {
  EXPECT_EQ(ParseListenAddress("--osc", "9000")->ip, uint32_t{INADDR_LOOPBACK});
  EXPECT_EQ(ParseListenAddress("--osc", "9000")->port, 9000);
  EXPECT_EQ(ParseListenAddress("--osc", "10.0.0.7:57120")->ip, 0x0a000007u);
  EXPECT_EQ(ParseListenAddress("--osc", "lo:9000")->ip, uint32_t{INADDR_LOOPBACK});
  EXPECT_THAT(ParseListenAddress("--osc", "0").message(), HasSubstr("1 to 65535"));
  EXPECT_THAT(ParseListenAddress("--osc", "70000").message(), HasSubstr("1 to 65535"));
  EXPECT_THAT(ParseListenAddress("--osc", "nowhere0:9000").message(),
              HasSubstr("not an IPv4 address or a network interface"));
}

TEST(OscListener, HearsThisMachineAndRefusesNoise) {
  const std::shared_ptr<Log> log = MakeSilentLog();
  const auto listener = OscListener::Open({INADDR_LOOPBACK, 0}, *log);
  ASSERT_TRUE(listener.ok()) << listener.message();
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons((*listener)->port());
  const auto send = [&](const std::vector<std::byte>& packet) {
    sendto(sender, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to),
           sizeof(to));
  };
  send(std::vector<std::byte>(100, std::byte{0xff}));
  send({});
  send(Packet("/door/open", "i", 1));
  std::vector<std::string> heard;
  for (int i = 0; i < 400 && heard.empty(); ++i) {
    std::this_thread::sleep_for(5ms);
    heard = (*listener)->Take();
  }
  EXPECT_THAT(heard, ElementsAre("/door/open,1"));
  EXPECT_THAT((*listener)->Take(), IsEmpty());
  EXPECT_THAT(OscListener::Open({INADDR_LOOPBACK, (*listener)->port()}, *log).message(),
              HasSubstr("cannot be opened"));
  close(sender);
}

}  // namespace
}  // namespace lararium::player
