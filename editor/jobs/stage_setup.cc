#include "editor/jobs/stage_setup.h"

#include <utility>
#include <vector>

#include "editor/jobs/baking.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "shared/audio/sound_file.h"

namespace lararium::editor {

Status FillStage(const ProjectPaths& paths,
                 const ProjectDocument& document,
                 const std::string& spoken,
                 stage::Stage& stage,
                 show::ShowContent& content) {
  for (const CastDocument& member : document.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const show::CastMember person,
                              ShareBakedHuman(paths, member, kAnyDetail));
    LARARIUM_RETURN_IF_ERROR(stage.Add(member.name, person.model).status());
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto objects, LoadObjects(paths, document));
  for (const show::StageObject& object : objects) {
    LARARIUM_RETURN_IF_ERROR(
        stage.AddObject(object.name, object.model, object.stage_from_object).status());
  }
  LARARIUM_RETURN_IF_ERROR(
      AddLines(paths, document, {spoken, std::string(show::kNoCaptions)}, content));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<audio::SoundData> sounds, LoadSounds(paths));
  for (const audio::SoundData& sound : sounds) {
    LARARIUM_ASSIGN_OR_RETURN(const auto reader, audio::SoundReader::Open(sound.bytes, sound.name));
    LARARIUM_RETURN_IF_ERROR(stage.sounds().Add(sound.name, reader.seconds()));
  }
  for (const show::Speech& speech : content.speech) {
    LARARIUM_RETURN_IF_ERROR(stage.AddSpeech(speech.name, speech.visemes));
  }
  std::vector<stage::Place> places;
  for (const PlaceDocument& place : document.places) {
    LARARIUM_ASSIGN_OR_RETURN(stage::Place staged, StageObstacles(paths, place));
    places.push_back(std::move(staged));
  }
  return stage.SetFloor({}, places);
}

}  // namespace lararium::editor
