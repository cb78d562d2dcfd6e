#include "editor/desktop/file_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Kind = FilePlace::Kind;

TEST(FilePlaces, TakesTheFoldersThatTheDesktopNames) {
  EXPECT_THAT(UserPlaces("# A comment\n"
                         "XDG_DESKTOP_DIR=\"$HOME/Schreibtisch\"\n"
                         "XDG_MUSIC_DIR=\"$HOME/Musik\"\n"
                         "XDG_VIDEOS_DIR=\"/data/Videos\"\n",
                         "/home/a"),
              ElementsAre(FilePlace{Kind::kDesktop, "/home/a/Schreibtisch"},
                          FilePlace{Kind::kVideos, "/data/Videos"}));
}

TEST(FilePlaces, LeavesOutFoldersThatAreTheHomeOrCannotBeRead) {
  EXPECT_THAT(UserPlaces("XDG_DESKTOP_DIR=\"$HOME/\"\nXDG_VIDEOS_DIR=\"videos\"\n"
                         "XDG_PICTURES_DIR=\"\nXDG_DOCUMENTS_DIR=",
                         "/home/a"),
              IsEmpty());
}

TEST(FilePlaces, FindsMountedMedia) {
  EXPECT_THAT(MountedMedia("22 1 8:1 / / rw - ext4 /dev/sda1 rw\n"
                           "30 22 8:17 / /media/a/STICK\\040ONE rw - vfat /dev/sdb1 rw\n"
                           "31 22 8:33 / /run/media/a/CARD rw - exfat /dev/sdc1 rw\n"
                           "cut off\n"),
              ElementsAre(FilePlace{Kind::kMedia, "/media/a/STICK ONE"},
                          FilePlace{Kind::kMedia, "/run/media/a/CARD"}));
}

}  // namespace
}  // namespace lararium::editor
