// reduce_person IN.larhuman OUT.larhuman
// Computes the light transfer of a person without reflections, reduces the person as an export for
// browsers does, and writes it as one file again.

#include <cstdio>
#include <filesystem>
#include <utility>

#include "editor/bake/transfer.h"
#include "editor/export/web_content.h"
#include "shared/core/file.h"
#include "shared/human/human.h"

namespace lararium::exporter {
namespace {

Status ReducePersonFile(const std::filesystem::path& in, const std::filesystem::path& out) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, human::LoadHuman(in));
  NoProgress progress;
  bake::TransferOptions direct;
  direct.bounces = 0;
  LARARIUM_ASSIGN_OR_RETURN(human.light, bake::BakeTransfer(human, direct, progress));
  ExportContent content;
  CastContent& person = content.cast.emplace_back();
  person.name = in.stem().string();
  person.human = human::SerializeHuman(human);
  LARARIUM_RETURN_IF_ERROR(ReduceForWeb(content, progress));
  LARARIUM_ASSIGN_OR_RETURN(human, human::ParseHuman(person.human, in.string()));
  LARARIUM_ASSIGN_OR_RETURN(human::Human motion, human::ParseHuman(person.motion, in.string()));
  human.clips = std::move(motion.clips);
  return WriteFileAtomically(out, human::SerializeHuman(human));
}

}  // namespace
}  // namespace lararium::exporter

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: reduce_person IN.larhuman OUT.larhuman\n");
    return 2;
  }
  const lararium::Status status = lararium::exporter::ReducePersonFile(argv[1], argv[2]);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
