#include "player/fleet/fleet_options.h"

#include <unistd.h>

#include "player/kiosk/secret_file.h"
#include "shared/core/file.h"
#include "shared/group/group_message.h"

namespace lararium::player {
namespace {

constexpr size_t kMostName = 64;
constexpr size_t kMostPath = 4096;

std::string Base(std::string_view site, std::string_view kind, std::string_view name) {
  std::string base = "lararium/";
  base.append(site).append("/").append(kind).append("/").append(name);
  return base;
}

void DescribePath(Fields& fields, std::string_view name, std::filesystem::path& path) {
  std::string text = path.string();
  fields.Text(Optional(name, !text.empty()), text, kMostPath);
  path = text;
}

}  // namespace

FleetAddress FleetOptions::broker() const { return *ParseFleetAddress("fleet", address); }

Status FleetOptions::Validate() const {
  LARARIUM_RETURN_IF_ERROR(ParseFleetAddress("fleet", address).status());
  LARARIUM_RETURN_IF_ERROR(CheckFleetName("name in the fleet", name));
  if (!group.empty()) {
    LARARIUM_RETURN_IF_ERROR(CheckFleetName("group in the fleet", group));
  }
  if (password.empty() == certificate.empty() || certificate.empty() != key.empty()) {
    return Status::Error("fleet", "the device cannot prove its name to the broker",
                         "give either a password file, or a certificate and its key");
  }
  for (const std::filesystem::path& secret : {password, key}) {
    if (!secret.empty()) {
      LARARIUM_RETURN_IF_ERROR(CheckSecretFile(secret));
    }
  }
  for (const std::filesystem::path& file : {authority, password, certificate, key}) {
    if (!file.empty() && !FileExists(file)) {
      return Status::Error(file.string(), "is missing", "copy the device's folder of the fleet");
    }
  }
  return Status();
}

void DescribeFields(Fields& fields, FleetOptions& options) {
  fields.Text("address", options.address, kMostPath);
  fields.Check(fields.reading()
                   ? ParseFleetAddress(fields.where("address"), options.address).status()
                   : Status());
  fields.Text(Optional("name", !options.name.empty()), options.name, kMostName);
  fields.Text(Optional("group", !options.group.empty()), options.group, kMostName);
  fields.Flag(Optional("guide", options.guide), options.guide);
  DescribePath(fields, "authority", options.authority);
  DescribePath(fields, "password", options.password);
  DescribePath(fields, "certificate", options.certificate);
  DescribePath(fields, "key", options.key);
}

void ResolvePaths(const std::filesystem::path& folder, FleetOptions& options) {
  for (std::filesystem::path* path :
       {&options.authority, &options.password, &options.certificate, &options.key}) {
    if (!path->empty()) {
      *path = folder / *path;
    }
  }
}

void NameDevice(FleetOptions& options) {
  char name[256] = "";
  if (options.name.empty() && ::gethostname(name, sizeof(name) - 1) == 0) {
    options.name = std::string(name).substr(0, std::string_view(name).find('.'));
  }
}

std::string DeviceCommands(std::string_view site, std::string_view name) {
  return Base(site, "device", name) + "/do";
}

std::string GroupCommands(std::string_view site, std::string_view group) {
  return Base(site, "group", group) + "/do";
}

FleetTopics TopicsOf(std::string_view site, std::string_view name, std::string_view group) {
  const std::string base = Base(site, "device", name);
  FleetTopics topics;
  topics.state = base + "/state";
  topics.presence = base + "/presence";
  topics.statistics = base + "/statistics";
  topics.commands = {DeviceCommands(site, name)};
  if (!group.empty()) {
    topics.commands.push_back(GroupCommands(site, group));
    const std::string together = Base(site, "group", group);
    const std::string own(name);
    topics.to_all = together + "/all/" + own;
    topics.to_one = together + "/to/+/" + own;
    for (const std::string& others : {std::string("+"), std::string(group::kPage) + "+"}) {
      topics.heard.push_back(together + "/all/" + others);
      topics.heard.push_back(together + "/to/" + own + "/" + others);
      topics.presences.push_back(Base(site, "device", others) + "/presence");
    }
  }
  return topics;
}

}  // namespace lararium::player
