#include "player/fleet/fleet_setup.h"

#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "player/fleet/fleet_certificates.h"
#include "player/fleet/fleet_options.h"
#include "player/fleet/floor_plan.h"
#include "player/kiosk/secret_file.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/group/group_message.h"

namespace lararium::player {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMostPlanBytes = 1 << 20;
constexpr size_t kMostText = 4096;
constexpr size_t kMostPlanHost = 253;

// Files are made for their owner alone while this exists.
class PrivateFiles {
 public:
  PrivateFiles() : before_(::umask(0077)) {}
  ~PrivateFiles() { ::umask(before_); }
  PrivateFiles(const PrivateFiles&) = delete;
  PrivateFiles& operator=(const PrivateFiles&) = delete;

 private:
  mode_t before_;
};

void DescribeDevice(Fields& fields, FleetDevice& device) {
  fields.Text("name", device.name, kMostText);
  fields.Check(fields.reading() ? CheckFleetName(fields.where("name"), device.name) : Status());
  fields.Text(Optional("group", !device.group.empty()), device.group, kMostText);
  fields.Check(fields.reading() && !device.group.empty()
                   ? CheckFleetName(fields.where("group"), device.group)
                   : Status());
  fields.Flag(Optional("guide", device.guide), device.guide);
}

void DescribePlan(Fields& fields, FleetPlan& plan) {
  fields.Schema(1, "was written by a newer player", "update the player");
  fields.Text("host", plan.host, kMostPlanHost);
  fields.Text("site", plan.site, kMostText);
  fields.Integer("port", plan.port, 1, 65535);
  fields.Integer("page_port", plan.page_port, 1, 65535);
  fields.Text("broker_folder", plan.broker_folder, kMostText);
  fields.Flag("certificates", plan.certificates);
  fields.List("devices", plan.devices, FleetPlan::kMostDevices, DescribeDevice);
}

Status Validate(const FleetPlan& plan, const std::string& where) {
  if (!IsHost(plan.host)) {
    return Status::Error(where, "\"" + plan.host + "\" is not an IP address or the name of a host",
                         "give the address at which devices reach the broker with --host");
  }
  LARARIUM_RETURN_IF_ERROR(CheckFleetName(where + ": site", plan.site));
  const bool plain = std::all_of(plan.broker_folder.begin(), plan.broker_folder.end(),
                                 [](char c) { return c > 0x20 && c < 0x7f; });
  if (!plain || !plan.broker_folder.starts_with('/')) {
    return Status::Error(where, "the folder of the broker must be an absolute path without spaces");
  }
  if (plan.port == plan.page_port) {
    return Status::Error(where, "devices and pages have the same port",
                         "give them different ones with --port and --page-port");
  }
  std::vector<std::string> names = {FleetPlan::kStaff, FleetPlan::kVisitors, "page"};
  for (const FleetDevice& device : plan.devices) {
    if (std::find(names.begin(), names.end(), device.name) != names.end()) {
      return Status::Error(
          where, "the name \"" + device.name + "\" is taken",
          "give each device a name of its own, other than \"staff\", \"visitors\" and \"page\"");
    }
    names.push_back(device.name);
    const auto members = std::count_if(
        plan.devices.begin(), plan.devices.end(),
        [&](const FleetDevice& d) { return !d.group.empty() && d.group == device.group; });
    if (members > static_cast<std::ptrdiff_t>(group::kMostGroupMembers)) {
      return Status::Error(where, "the group \"" + device.group + "\" has more than 32 devices",
                           "make it two groups");
    }
  }
  return Status();
}

template <typename T>
void Change(T& value, const T& wanted) {
  if (wanted != T()) {
    value = wanted;
  }
}

// The plan of a folder with the changes.
Result<FleetPlan> ChangedPlan(const FleetSetupOptions& options) {
  const fs::path file = options.folder / "fleet.json";
  FleetPlan plan;
  if (FileExists(file)) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMostPlanBytes));
    LARARIUM_ASSIGN_OR_RETURN(plan, ParseFleetPlan(text, file.string()));
  }
  Change(plan.host, options.host);
  Change(plan.site, options.site);
  Change(plan.broker_folder, options.broker_folder);
  plan.port = options.port.value_or(plan.port);
  plan.page_port = options.page_port.value_or(plan.page_port);
  plan.certificates = options.certificates.value_or(plan.certificates);
  for (const std::string& text : options.devices) {
    const size_t colon = text.find(':');
    FleetDevice device = {text.substr(0, colon),
                          colon == std::string::npos ? "" : text.substr(colon + 1)};
    LARARIUM_RETURN_IF_ERROR(CheckFleetName("--add", device.name));
    if (colon != std::string::npos) {
      LARARIUM_RETURN_IF_ERROR(CheckFleetName("--add " + device.name, device.group));
    }
    std::erase_if(plan.devices, [&](const FleetDevice& d) { return d.name == device.name; });
    plan.devices.push_back(std::move(device));
  }
  for (const std::string& name : options.guides) {
    const auto found = std::find_if(plan.devices.begin(), plan.devices.end(),
                                    [&](const FleetDevice& d) { return d.name == name; });
    if (found == plan.devices.end() || found->group.empty()) {
      return Status::Error("--guide", "the fleet has no device \"" + name + "\" in a group",
                           "add it with --add " + name + ":GROUP");
    }
    for (FleetDevice& device : plan.devices) {
      device.guide = device.group == found->group ? device.name == name : device.guide;
    }
  }
  for (const std::string& name : options.removed) {
    if (std::erase_if(plan.devices, [&](const FleetDevice& d) { return d.name == name; }) == 0) {
      return Status::Error("--remove", "the fleet has no device \"" + name + "\"");
    }
  }
  if (plan.devices.size() > FleetPlan::kMostDevices) {
    return Status::Error("--add", "a fleet has at most 1000 devices");
  }
  LARARIUM_RETURN_IF_ERROR(Validate(plan, options.folder.string()));
  return plan;
}

Status MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  return error ? Status::Error(folder.string(), error.message()) : Status();
}

Result<CertificateAuthority> LoadOrMakeAuthority(const fs::path& folder, const std::string& site) {
  const fs::path certificate = folder / "authority.crt";
  const fs::path key = folder / "authority.key";
  if (FileExists(certificate) || FileExists(key)) {
    CertificateFiles files;
    LARARIUM_ASSIGN_OR_RETURN(files.certificate, ReadText(certificate, kMostPlanBytes));
    LARARIUM_ASSIGN_OR_RETURN(files.key, ReadText(key, kMostPlanBytes));
    return CertificateAuthority::Parse(files, certificate.string());
  }
  LARARIUM_ASSIGN_OR_RETURN(CertificateAuthority made,
                            CertificateAuthority::Make("Lararium fleet " + site));
  const CertificateFiles files = made.files();
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(key, files.key));
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(certificate, files.certificate));
  return made;
}

// The password in a file, which is made if it is missing.
Result<std::string> LoadOrMakePassword(const fs::path& file) {
  if (FileExists(file)) {
    return ReadSecretLine(file);
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string password, MakePassword());
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(file, password + "\n"));
  return password;
}

std::string Configuration(const FleetPlan& plan) {
  const std::string files = plan.broker_folder + "/";
  const std::string tls = "cafile " + files + "authority.crt\ncertfile " + files +
                          "server.crt\nkeyfile " + files + "server.key\n";
  return "# Written by lararium-player fleet-setup. Players connect to the first port, pages\n"
         "# to the second.\n"
         "allow_anonymous false\n"
         "password_file " +
         files +
         "passwords\n"
         "acl_file " +
         files +
         "rights\n"
         "max_packet_size 65536\n\n"
         "listener " +
         std::to_string(plan.port) + "\n" + tls +
         (plan.certificates ? "require_certificate true\nuse_identity_as_username true\n" : "") +
         "\nlistener " + std::to_string(plan.page_port) + "\nprotocol websockets\n" + tls;
}

// The topic of messages to one member, for members that are pages.
std::string ToPages(std::string to_one) {
  return to_one.replace(to_one.find("/to/+/"), 6, "/to/" + std::string(group::kPage) + "+/");
}

// The rights of visitors' pages, whose password is public. The id of a client is the name of its
// page, so that a page writes under its own name only.
std::string RightsOfPages(const FleetPlan& plan) {
  const FleetTopics all = TopicsOf(plan.site, "+", "+");
  std::string text = std::string("\nuser ") + FleetPlan::kVisitors + "\n";
  for (const std::string& topic : all.presences) {
    text += "topic read " + topic + "\n";
  }
  text += "topic read " + GroupCommands(plan.site, "+") + "\n";
  const FleetTopics page = TopicsOf(plan.site, std::string(group::kPage) + "%c", "+");
  for (const std::string& topic : page.heard) {
    text +=
        (topic.find("%c") == std::string::npos ? "topic read " : "pattern read ") + topic + "\n";
  }
  text += "pattern read " + page.commands.front() + "\n";
  for (const std::string& topic :
       {page.state, page.presence, page.to_all, page.to_one, ToPages(page.to_one)}) {
    text += "pattern write " + topic + "\n";
  }
  return text;
}

// A device may write its own state, presence and statistics, and read its own commands and those of
// its group. Members of a group write to each other under their own names, and hear who of them is
// gone. The staff may write what devices wrote, to delete that of devices that are no more.
std::string Rights(const FleetPlan& plan) {
  const std::string all = "topic readwrite lararium/" + plan.site + "/device/+/";
  const FleetTopics pages = TopicsOf(plan.site, std::string(group::kPage) + "+", "");
  std::string text = std::string("user ") + FleetPlan::kStaff + "\n" + all + "state\n" + all +
                     "presence\n" + all + "statistics\ntopic readwrite " + pages.state +
                     "\ntopic readwrite " + pages.presence + "\ntopic write " +
                     DeviceCommands(plan.site, "+") + "\ntopic write " + pages.commands.front() +
                     "\ntopic write " + GroupCommands(plan.site, "+") + "\n";
  for (const FleetDevice& device : plan.devices) {
    const FleetTopics topics = TopicsOf(plan.site, device.name, device.group);
    text += "\nuser " + device.name + "\ntopic write " + topics.state + "\ntopic write " +
            topics.presence + "\ntopic write " + topics.statistics + "\n";
    for (const std::string& commands : topics.commands) {
      text += "topic read " + commands + "\n";
    }
    if (device.group.empty()) {
      continue;
    }
    for (const std::string& topic : {topics.to_all, topics.to_one, ToPages(topics.to_one)}) {
      text += "topic write " + topic + "\n";
    }
    for (const std::string& topic : topics.heard) {
      text += "topic read " + topic + "\n";
    }
    text += "topic read " + pages.presence + "\n";
    for (const FleetDevice& other : plan.devices) {
      if (other.group == device.group && other.name != device.name) {
        text += "topic read " + TopicsOf(plan.site, other.name, "").presence + "\n";
      }
    }
  }
  return text + RightsOfPages(plan);
}

Status WriteDevice(const fs::path& folder,
                   const FleetPlan& plan,
                   const FleetDevice& device,
                   const CertificateAuthority& authority) {
  LARARIUM_RETURN_IF_ERROR(MakeFolder(folder));
  FleetOptions options;
  const bool is_ipv6 = plan.host.find(':') != std::string::npos;
  options.address = "mqtts://" + (is_ipv6 ? "[" + plan.host + "]" : plan.host) + ":" +
                    std::to_string(plan.port) + "/" + plan.site;
  options.name = device.name;
  options.group = device.group;
  options.guide = device.guide;
  options.authority = "authority.crt";
  if (plan.certificates) {
    options.certificate = "device.crt";
    options.key = "device.key";
    if (!FileExists(folder / options.key)) {
      LARARIUM_ASSIGN_OR_RETURN(const CertificateFiles files, authority.MakeClient(device.name));
      LARARIUM_RETURN_IF_ERROR(
          WriteFileAtomically(folder / options.certificate, files.certificate));
      LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(folder / options.key, files.key));
    }
  } else {
    options.password = "password";
    LARARIUM_RETURN_IF_ERROR(LoadOrMakePassword(folder / options.password).status());
  }
  LARARIUM_RETURN_IF_ERROR(
      WriteFileAtomically(folder / options.authority, authority.files().certificate));
  const Json json = {{"schema", 1}, {"fleet", FormatFields(options)}};
  return SaveJson(folder / "device.json", json);
}

// Writes the page with what it has to know.
Status WritePage(const fs::path& folder, const FleetPlan& plan, const FleetSetupOptions& options) {
  LARARIUM_RETURN_IF_ERROR(MakeFolder(folder));
  std::error_code error;
  if (FileExists(options.page)) {
    fs::copy(options.page, folder,
             fs::copy_options::overwrite_existing | fs::copy_options::recursive, error);
  }
  if (error) {
    return Status::Error(options.page.string(), "cannot be copied: " + error.message());
  }
  if (!options.show.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(options.show));
    LARARIUM_ASSIGN_OR_RETURN(const Json plans, PlansOf(bundle));
    LARARIUM_RETURN_IF_ERROR(SaveJson(folder / "plans.json", plans));
  }
  const Json settings = {
      {"schema", 1}, {"site", plan.site}, {"host", plan.host}, {"page_port", plan.page_port}};
  return SaveJson(folder / "settings.json", settings);
}

}  // namespace

Result<FleetPlan> ParseFleetPlan(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(FleetPlan plan, ParseFields<FleetPlan>(text, where, DescribePlan));
  LARARIUM_RETURN_IF_ERROR(Validate(plan, where));
  return plan;
}

Result<size_t> SetUpFleet(const FleetSetupOptions& options) {
  const PrivateFiles only_for_owner;
  LARARIUM_ASSIGN_OR_RETURN(const FleetPlan plan, ChangedPlan(options));
  const fs::path broker = options.folder / "broker";
  const fs::path devices = options.folder / "devices";
  LARARIUM_RETURN_IF_ERROR(MakeFolder(broker));
  LARARIUM_RETURN_IF_ERROR(WritePage(broker / "page", plan, options));
  LARARIUM_ASSIGN_OR_RETURN(const CertificateAuthority authority,
                            LoadOrMakeAuthority(options.folder, plan.site));
  LARARIUM_ASSIGN_OR_RETURN(const CertificateFiles server, authority.MakeServer(plan.host));
  LARARIUM_ASSIGN_OR_RETURN(const std::string staff,
                            LoadOrMakePassword(options.folder / "staff.password"));
  LARARIUM_ASSIGN_OR_RETURN(std::string passwords, PasswordLine(FleetPlan::kStaff, staff));
  LARARIUM_ASSIGN_OR_RETURN(const std::string visitors,
                            LoadOrMakePassword(options.folder / "visitors.password"));
  LARARIUM_ASSIGN_OR_RETURN(const std::string visitors_line,
                            PasswordLine(FleetPlan::kVisitors, visitors));
  passwords += visitors_line;
  for (const FleetDevice& device : plan.devices) {
    const fs::path folder = devices / device.name;
    LARARIUM_RETURN_IF_ERROR(WriteDevice(folder, plan, device, authority));
    if (!plan.certificates) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string password, ReadSecretLine(folder / "password"));
      LARARIUM_ASSIGN_OR_RETURN(const std::string line, PasswordLine(device.name, password));
      passwords += line;
    }
  }
  for (const std::string& name : options.removed) {
    std::error_code ignored;
    fs::remove_all(devices / name, ignored);
  }
  const std::pair<const char*, std::string> files[] = {
      {"lararium.conf", Configuration(plan)},
      {"rights", Rights(plan)},
      {"passwords", passwords},
      {"authority.crt", authority.files().certificate},
      {"server.crt", server.certificate},
      {"server.key", server.key}};
  for (const auto& [name, text] : files) {
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(broker / name, text));
  }
  LARARIUM_RETURN_IF_ERROR(
      SaveJson(options.folder / "fleet.json", FormatFields(plan, DescribePlan)));
  return plan.devices.size();
}

}  // namespace lararium::player
