#include "editor/jobs/shared_people.h"

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "shared/core/file.h"
#include "shared/human/human.h"
#include "shared/human/texture_pool.h"

namespace lararium::editor {
namespace {

// Programs replace a file as a whole, so a changed file has at least a new inode.
using Stamp = std::array<int64_t, 5>;

Stamp StampOf(const std::filesystem::path& file) {
  struct stat found = {};
  if (::stat(file.c_str(), &found) != 0) {
    return {};
  }
  return {static_cast<int64_t>(found.st_dev), static_cast<int64_t>(found.st_ino), found.st_size,
          found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

struct Held {
  Stamp stamp = {};
  std::weak_ptr<const show::CastMember> person;
};

// Callers that want the same person wait until it is read.
struct People {
  std::mutex mutex;
  std::multimap<std::filesystem::path, Held> held;
  human::TexturePool textures;
};

People& AllPeople() {
  static People people;
  return people;
}

// Each part shares ownership of the whole person, so that it never has to be read again while a
// part is in use.
show::CastMember Shared(const std::shared_ptr<const show::CastMember>& person) {
  show::CastMember shared = *person;
  shared.human = {person, person->human.get()};
  shared.light = {person, person->light.get()};
  shared.model = {person, person->model.get()};
  return shared;
}

Result<human::Human> Read(const std::filesystem::path& file, float finest) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return human::ParseHuman(bytes, file.string(), finest);
}

}  // namespace

Result<show::CastMember> SharePerson(const std::filesystem::path& file, float finest) {
  People& people = AllPeople();
  const std::lock_guard lock(people.mutex);
  std::erase_if(people.held, [](const auto& entry) { return entry.second.person.expired(); });
  const Stamp stamp = StampOf(file);
  const auto [begin, end] = people.held.equal_range(file);
  for (auto held = begin; held != end; ++held) {
    const std::shared_ptr<const show::CastMember> person = held->second.person.lock();
    if (person != nullptr && held->second.stamp == stamp && person->finest <= finest) {
      return Shared(person);
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, Read(file, finest));
  const auto person = std::make_shared<const show::CastMember>(
      show::MakeCastMember(std::move(human), finest, people.textures));
  people.held.emplace(file, Held{stamp, person});
  return Shared(person);
}

show::ReadPerson ReadsAgain(const std::vector<std::filesystem::path>& files) {
  std::vector<Stamp> stamps;
  for (const std::filesystem::path& file : files) {
    stamps.push_back(StampOf(file));
  }
  return [files, stamps](size_t cast, float finest) -> Result<show::DrawnPerson> {
    LARARIUM_ASSIGN_OR_RETURN(human::Human human, Read(files[cast], finest));
    if (StampOf(files[cast]) != stamps[cast]) {
      return Status::Error(files[cast].string(), "has changed since it was read");
    }
    return show::MakeDrawnPerson(std::move(human), AllPeople().textures);
  };
}

}  // namespace lararium::editor
