// group_device NAME SEED
// A device of a group as a page has it (web/page/page_group.h), with a drama but without pictures,
// for group_test.mjs. It is compiled for both systems. Each line of the standard input is a frame,
// and each line of the output the answer:
//   {"now": microseconds, "take": [[FROM, HEX]], "keys": names of keys}
//   {"send": [[TO, HEX]], "seconds": of the drama, "leads": bool, "leader": NAME,
//    "marks": {"RUN TICK": hash}}

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

#include "shared/core/json.h"
#include "tests/group/group_player.h"
#include "web/page/page_group.h"

namespace lararium::test {
namespace {

std::string HexOf(std::string_view bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const char byte : bytes) {
    text += kDigits[static_cast<uint8_t>(byte) >> 4];
    text += kDigits[static_cast<uint8_t>(byte) & 15];
  }
  return text;
}

std::string BytesOf(const std::string& hex) {
  std::string bytes;
  for (size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

class GroupDevice {
 public:
  GroupDevice(const std::string& name, uint64_t seed)
      : seed_(seed),
        player_([this] { return 1e-6 * static_cast<double>(now_); }),
        group_({.name = name,
                .guide = false,
                .boot = 77 * seed,
                .wall = [this] { return int64_t{1'800'000'000'000'000} + now_; }},
               player_.feed(),
               [this] { return now_; }) {}

  std::string Answer(const std::string& line) {
    const Json asked = Json::parse(line);
    now_ = asked["now"].get<int64_t>();
    for (const Json& message : asked["take"]) {
      group_.Take(message[0].get<std::string>(), BytesOf(message[1].get<std::string>()));
    }
    drama::Visitor visitor = WanderingVisitor(seed_, 1e-6 * static_cast<double>(now_));
    visitor.keys = asked["keys"].get<std::string>();
    player_.Frame(visitor);
    group_.Step();
    Json answer = {
        {"send", Json::array()}, {"seconds", player_.seconds()}, {"marks", Json::object()}};
    for (const group::GroupMember::Outgoing& message : group_.TakeOutgoing()) {
      answer["send"].push_back({message.to, HexOf(message.bytes)});
      NoteMark(message.bytes, answer["marks"]);
    }
    const Json state = group_.State();
    answer["leads"] = state["leads"];
    answer["leader"] = state["leader"];
    return answer.dump();
  }

 private:
  // A member's beat has the hash of its drama's state two seconds ago.
  static void NoteMark(const std::string& bytes, Json& marks) {
    const Result<group::GroupMessage> message = group::ParseGroupMessage(bytes);
    const auto* beat = message.ok() ? std::get_if<group::GroupBeat>(&*message) : nullptr;
    if (beat != nullptr && beat->mark.tick > 0) {
      marks[std::to_string(beat->run) + " " + std::to_string(beat->mark.tick)] =
          std::to_string(beat->mark.hash);
    }
  }

  int64_t now_ = 0;
  uint64_t seed_;
  GroupPlayer player_;
  web::PageGroup group_;
};

}  // namespace
}  // namespace lararium::test

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: group_device NAME SEED\n");
    return 2;
  }
  lararium::test::GroupDevice device(argv[1], std::strtoull(argv[2], nullptr, 10));
  for (std::string line; std::getline(std::cin, line);) {
    std::cout << device.Answer(line) << std::endl;
  }
  return 0;
}
