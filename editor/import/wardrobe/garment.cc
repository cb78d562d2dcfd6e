#include "editor/import/wardrobe/garment.h"

#include <functional>
#include <iterator>
#include <utility>

#include "editor/import/wardrobe/around.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/finish.h"
#include "editor/import/wardrobe/hung.h"
#include "editor/import/wardrobe/mantle.h"
#include "editor/import/wardrobe/sandals.h"

namespace lararium::import {
namespace {

// A layer is draped together: a piece before and one behind the body, or one piece. Each layer
// becomes a garment of its own, over those before it.
struct Layer {
  const GarmentPattern* pattern = nullptr;
  std::span<const Piece> pieces;
};

std::vector<Layer> LayersOf(const GarmentPattern& pattern) {
  std::vector<Layer> layers;
  for (std::span<const Piece> rest = pattern.design->pieces; !rest.empty();) {
    const size_t count = rest[0].placed == Placement::kFront ? 2 : 1;
    layers.push_back({&pattern, rest.first(count)});
    rest = rest.subspan(count);
  }
  return layers;
}

Result<DrapedGarment> Drape(const Layer& layer,
                            const FittedBody& body,
                            std::span<const DrapedGarment> worn,
                            const Progress& progress) {
  const GarmentPattern& pattern = *layer.pattern;
  switch (layer.pieces[0].placed) {
    case Placement::kFront:
    case Placement::kBack:
      return DrapeHung(pattern, layer.pieces, body, worn, progress);
    case Placement::kAround:
      return DrapeAround(pattern, layer.pieces[0], body, worn, progress);
    case Placement::kMantle:
      return DrapeMantle(pattern, layer.pieces[0], body, worn, progress);
    case Placement::kFoot:
      return CutSandals(pattern, body);
  }
  return Status::Error(pattern.design->file.string(), "has a piece of an unknown placement");
}

Status Cancelled() { return Status::Error("garments", "cancelled before they were cut"); }

// Drapes layers in their order, and reports how each lies to `fit`, whose error ends this.
Result<std::vector<DrapedGarment>> DrapeAll(
    std::span<const Layer> layers,
    const FittedBody& body,
    const Progress& progress,
    const std::function<Status(const Layer& layer, std::vector<PieceFit> fits)>& fit) {
  std::vector<DrapedGarment> worn;
  const StandingField standing(body);
  for (const Layer& layer : layers) {
    LARARIUM_ASSIGN_OR_RETURN(DrapedGarment draped, Drape(layer, body, worn, progress));
    if (progress.Cancelled()) {
      return Cancelled();
    }
    LARARIUM_RETURN_IF_ERROR(
        fit(layer, MeasureFit(draped, layer.pieces, layer.pattern->design->seams, body, standing)));
    worn.push_back(std::move(draped));
  }
  return worn;
}

}  // namespace

Result<std::vector<Garment>> CutGarments(std::span<const GarmentPattern> patterns,
                                         const FittedBody& body,
                                         const Progress& progress) {
  std::vector<Layer> layers;
  for (const GarmentPattern& pattern : patterns) {
    const std::vector<Layer> more = LayersOf(pattern);
    layers.insert(layers.end(), more.begin(), more.end());
  }
  LARARIUM_ASSIGN_OR_RETURN(
      std::vector<DrapedGarment> worn,
      DrapeAll(layers, body, progress, [](const Layer& layer, std::vector<PieceFit> fits) {
        return CheckFit(fits, *layer.pattern->design);
      }));
  const std::vector<DrapedGarment> whole = worn;
  for (size_t i = 0; i + 1 < worn.size(); ++i) {
    LeaveOutCovered(std::span(worn).subspan(i + 1), body, worn[i]);
  }
  std::vector<Garment> garments;
  for (size_t i = 0; i < worn.size(); ++i) {
    if (progress.Cancelled()) {
      return Cancelled();
    }
    LARARIUM_ASSIGN_OR_RETURN(Garment garment,
                              FinishGarment(worn[i], whole[i], *layers[i].pattern, body));
    garments.push_back(std::move(garment));
  }
  return garments;
}

Result<std::vector<PieceFit>> TryOn(const GarmentPattern& pattern,
                                    const FittedBody& body,
                                    const Progress& progress) {
  std::vector<PieceFit> all;
  const auto draped =
      DrapeAll(LayersOf(pattern), body, progress, [&](const Layer&, std::vector<PieceFit> fits) {
        std::move(fits.begin(), fits.end(), std::back_inserter(all));
        return Status();
      });
  LARARIUM_RETURN_IF_ERROR(draped.status());
  return all;
}

}  // namespace lararium::import
