#include "editor/import/wardrobe/garment.h"

#include <utility>

#include "editor/import/wardrobe/around.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/finish.h"
#include "editor/import/wardrobe/hung.h"
#include "editor/import/wardrobe/mantle.h"
#include "editor/import/wardrobe/sandals.h"

namespace lararium::import {
namespace {

Result<DrapedGarment> Drape(const GarmentPattern& pattern,
                            const FittedBody& body,
                            std::span<const DrapedGarment> worn,
                            const Progress& progress) {
  switch (pattern.design->pieces[0].placed) {
    case Placement::kFront:
    case Placement::kBack:
      return DrapeHung(pattern, body, worn, progress);
    case Placement::kAround:
      return DrapeAround(pattern, body, worn, progress);
    case Placement::kMantle:
      return DrapeMantle(pattern, body, worn, progress);
    case Placement::kFoot:
      return CutSandals(pattern, body);
  }
  return Status::Error(pattern.design->file.string(), "has a piece of an unknown placement");
}

Status Continue(const Progress& progress) {
  return progress.Cancelled() ? Status::Error("garments", "cancelled before they were cut")
                              : Status();
}

}  // namespace

Result<std::vector<Garment>> CutGarments(std::span<const GarmentPattern> patterns,
                                         const FittedBody& body,
                                         const Progress& progress) {
  std::vector<DrapedGarment> worn;
  const StandingField standing(body);
  for (const GarmentPattern& pattern : patterns) {
    LARARIUM_ASSIGN_OR_RETURN(DrapedGarment draped, Drape(pattern, body, worn, progress));
    LARARIUM_RETURN_IF_ERROR(Continue(progress));
    LARARIUM_RETURN_IF_ERROR(
        CheckFit(MeasureFit(draped, *pattern.design, body, standing), *pattern.design));
    worn.push_back(std::move(draped));
  }
  const std::vector<DrapedGarment> whole = worn;
  for (size_t i = 0; i + 1 < worn.size(); ++i) {
    LeaveOutCovered(std::span(worn).subspan(i + 1), body, worn[i]);
  }
  std::vector<Garment> garments;
  for (size_t i = 0; i < worn.size(); ++i) {
    LARARIUM_RETURN_IF_ERROR(Continue(progress));
    LARARIUM_ASSIGN_OR_RETURN(Garment garment, FinishGarment(worn[i], whole[i], patterns[i], body));
    garments.push_back(std::move(garment));
  }
  return garments;
}

Result<std::vector<PieceFit>> TryOn(const GarmentPattern& pattern,
                                    const FittedBody& body,
                                    const Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const DrapedGarment draped, Drape(pattern, body, {}, progress));
  LARARIUM_RETURN_IF_ERROR(Continue(progress));
  return MeasureFit(draped, *pattern.design, body, StandingField(body));
}

}  // namespace lararium::import
