#include "editor/panels/widgets/icons.h"

#include <utility>

namespace lararium::panels {

namespace {

// In the order of the enumeration.
constexpr std::pair<Icon, char32_t> kLetters[kIcons] = {
    {Icon::kTrain, U'\uf567'},      {Icon::kAddSession, U'\uf569'},  {Icon::kBake, U'\uf238'},
    {Icon::kExport, U'\uf207'},     {Icon::kMove, U'\uf041'},        {Icon::kTurn, U'\uf467'},
    {Icon::kScale, U'\uf04c'},      {Icon::kUndo, U'\uf54c'},        {Icon::kRedo, U'\uf44e'},
    {Icon::kPlay, U'\uf40a'},       {Icon::kPause, U'\uf3e4'},       {Icon::kAdd, U'\uf415'},
    {Icon::kSnap, U'\uf347'},       {Icon::kRipple, U'\uf13e'},      {Icon::kFit, U'\uf616'},
    {Icon::kCameraView, U'\uf100'}, {Icon::kAroundView, U'\uf464'},  {Icon::kPicks, U'\uf1a3'},
    {Icon::kProject, U'\uf256'},    {Icon::kPlace, U'\uf34e'},       {Icon::kStage, U'\uf50d'},
    {Icon::kNudge, U'\uf4e1'},      {Icon::kProbe, U'\uf599'},       {Icon::kOccluder, U'\uf247'},
    {Icon::kPerson, U'\uf013'},     {Icon::kObject, U'\uf65a'},      {Icon::kCheckPoint, U'\uf5e1'},
    {Icon::kSpeech, U'\uf365'},     {Icon::kWalk, U'\uf583'},        {Icon::kUse, U'\uf2c7'},
    {Icon::kGesture, U'\uf64c'},    {Icon::kGaze, U'\uf208'},        {Icon::kExpression, U'\uf1f5'},
    {Icon::kClip, U'\uf230'},       {Icon::kLight, U'\uf5e2'},       {Icon::kSound, U'\uf387'},
    {Icon::kCaption, U'\uf15e'},    {Icon::kDescription, U'\uf219'}, {Icon::kMarker, U'\uf23d'},
    {Icon::kInfo, U'\uf2fd'},       {Icon::kWarning, U'\uf02a'},     {Icon::kError, U'\uf15d'},
    {Icon::kGood, U'\uf134'},       {Icon::kNothingYet, U'\uf130'},  {Icon::kUnclear, U'\uf625'},
    {Icon::kFound, U'\uf43e'},      {Icon::kLost, U'\uf0ad'},        {Icon::kSearching, U'\uf349'},
};

constexpr bool InOrder() {
  for (int i = 0; i < kIcons; ++i) {
    if (kLetters[i].first != static_cast<Icon>(i)) {
      return false;
    }
  }
  return true;
}
static_assert(InOrder());

}  // namespace

char32_t LetterOf(Icon icon) { return kLetters[static_cast<size_t>(icon)].second; }

std::string IconText(Icon icon) {
  const char32_t letter = LetterOf(icon);
  return {static_cast<char>(0xe0 | letter >> 12), static_cast<char>(0x80 | (letter >> 6 & 0x3f)),
          static_cast<char>(0x80 | (letter & 0x3f))};
}

std::string WithIcon(Icon icon, std::string_view text) {
  return IconText(icon) + "  " + std::string(text);
}

Icon IconOf(drama::LaneKind kind) {
  constexpr std::pair<std::string_view, Icon> kNamed[] = {
      {"speech", Icon::kSpeech},   {"walk", Icon::kWalk},     {"use", Icon::kUse},
      {"gesture", Icon::kGesture}, {"gaze", Icon::kGaze},     {"expression", Icon::kExpression},
      {"clip", Icon::kClip},       {"light", Icon::kLight},   {"sound", Icon::kSound},
      {"caption", Icon::kCaption}, {"marker", Icon::kMarker}, {"description", Icon::kDescription}};
  for (const auto& [name, icon] : kNamed) {
    if (name == drama::SpecOf(kind).icon) {
      return icon;
    }
  }
  return Icon::kStage;
}

}  // namespace lararium::panels
