#include "editor/app/shared_people.h"

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace lararium::app {
namespace {

// Files are replaced as a whole, so that a new one has another number at least.
using Stamp = std::array<int64_t, 5>;

Stamp StampOf(const std::filesystem::path& file) {
  struct stat found = {};
  if (::stat(file.c_str(), &found) != 0) {
    return {};
  }
  return {static_cast<int64_t>(found.st_dev), static_cast<int64_t>(found.st_ino), found.st_size,
          found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

// Whoever holds the human holds its light, so that nobody has to read it again for that.
struct Person {
  human::Human human;
  std::shared_ptr<const show::UnpackedLight> light;
};

struct Held {
  Stamp stamp = {};
  std::weak_ptr<const Person> person;
};

// Whoever wants the same person waits until they are read.
struct People {
  std::mutex mutex;
  std::map<std::filesystem::path, Held> held;
};

People& AllPeople() {
  static People people;
  return people;
}

SharedPerson Shared(const std::shared_ptr<const Person>& person) {
  return {{person, &person->human}, {person, person->light.get()}};
}

}  // namespace

Result<SharedPerson> SharePerson(const std::filesystem::path& file) {
  People& people = AllPeople();
  const std::lock_guard lock(people.mutex);
  std::erase_if(people.held, [](const auto& entry) { return entry.second.person.expired(); });
  const Stamp stamp = StampOf(file);
  if (const auto held = people.held.find(file);
      held != people.held.end() && held->second.stamp == stamp) {
    if (const auto person = held->second.person.lock()) {
      return Shared(person);
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, human::LoadHuman(file));
  auto person = std::make_shared<Person>();
  person->light = show::TakeLight(human.light);
  person->human = std::move(human);
  people.held[file] = {stamp, person};
  return Shared(person);
}

}  // namespace lararium::app
