// libFuzzer harness: any text as a device file, as a kiosk's state and statistics, as a command of
// its staff page or its fleet, as the address and the plan of a fleet, and as the key that shows
// must be signed with.

#include <cmath>
#include <span>
#include <string_view>

#include "player/app/device_file.h"
#include "player/fleet/command_gate.h"
#include "player/fleet/fleet_options.h"
#include "player/fleet/fleet_setup.h"
#include "player/kiosk/kiosk_state.h"
#include "player/kiosk/visit_statistics.h"
#include "player/staff/staff_messages.h"
#include "player/staff/staff_texts.h"
#include "shared/bundle/signature.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto device = player::ParseDevice(text, "device.json"); device.ok()) {
    CHECK(device->lost.Validate().ok());
    CHECK(!device->camera || device->camera->Validate().ok());
    CHECK(!device->fleet || player::ParseFleetAddress("fleet", device->fleet->address).ok());
    if (device->headset && device->headset->panel) {
      const Eigen::AlignedBox2d part = device->headset->SeenPart();
      CHECK(part.isEmpty() || part.sizes().allFinite());
      for (const geometry::LensModel& lens : device->headset->panel->lenses) {
        CHECK(lens.Validate().ok());
      }
    }
  }
  if (const auto state = player::ParseKioskState(text, "state.json"); state.ok()) {
    CHECK(state->seconds >= 0.0 && state->choices.volume >= 0.0 && state->choices.volume <= 1.0);
  }
  if (const auto days = player::ParseVisitStatistics(text, "statistics.json"); days.ok()) {
    CHECK(days->days().size() <= player::VisitStatistics::kMostDays);
    CHECK(days->ToCsv().starts_with("day,"));
    const std::string published = player::PublishedStatistics(*days);
    CHECK(published.size() <= player::kMostPublishedBytes);
    const auto told = player::ParseVisitStatistics(published, "published");
    CHECK(told.ok());
    for (const player::DayCounts& day : told->days()) {
      for (const auto& [cell, visits] : day.details->lost) {
        CHECK(visits >= player::VisitDetails::kLeastTold);
      }
    }
  }
  if (const auto command = player::ParseStaffCommand(text); command.ok()) {
    CHECK(!command->volume || (*command->volume >= 0.0 && *command->volume <= 1.0));
  }
  player::CommandGate gate;
  CHECK(gate.Check(text, true, {}).ok() == false);
  if (gate.Check(text, false, {}).ok()) {
    CHECK(size <= player::kMostStaffCommand);
  }
  if (const auto address = player::ParseFleetAddress("--fleet", text); address.ok()) {
    CHECK(player::IsHost(address->host) && player::IsFleetName(address->site));
  }
  if (const auto plan = player::ParseFleetPlan(text, "fleet.json"); plan.ok()) {
    CHECK(plan->devices.size() <= player::FleetPlan::kMostDevices);
  }
  CHECK(player::StaffLanguage(text).size() == 2);
  if (const auto key = bundle::ParsePublicKey(text, "museum.pub"); key.ok()) {
    CHECK(!bundle::Verifies({}, {}, *key));
  }
  return 0;
}
