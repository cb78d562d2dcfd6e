#include "shared/render/gl/shader_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::render {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr EmbeddedText kSources[] = {
    {"main.frag", "// main\n#include \"a.glsl\"\n#include \"b.glsl\"\nvoid main() {}\n"},
    {"a.glsl", "float A();\n"},
    {"b.glsl", "#include \"a.glsl\"\nfloat B();"},
    {"broken.frag", "\n#include \"absent.glsl\"\n"},
    {"cycle.glsl", "#include \"cycle.glsl\"\nfloat C();\n"},
};

TEST(ShaderSource, PutsIncludesInPlaceOnce) {
  const auto shader = AssembleShader("main.frag", "#version 330 core\n", kSources);
  ASSERT_TRUE(shader.ok()) << shader.message();
  EXPECT_THAT(shader->files, ElementsAre("main.frag", "a.glsl", "b.glsl"));
  EXPECT_EQ(shader->text,
            "#version 330 core\n#line 1 0\n// main\n#line 1 1\nfloat A();\n#line 3 0\n"
            "#line 1 2\n#line 2 2\nfloat B();\n#line 4 0\nvoid main() {}\n");
}

TEST(ShaderSource, NamesFilesInCompilerLogs) {
  const auto shader = AssembleShader("main.frag", "", kSources);
  ASSERT_TRUE(shader.ok());
  EXPECT_EQ(shader->ExplainLog("1:7(3): error: no\n2(12) : error C0: bad\nnote\n9:1: what"),
            "a.glsl:7(3): error: no\nb.glsl:12) : error C0: bad\nnote\n9:1: what\n");
}

TEST(ShaderSource, SaysWhereAnIncludeIsMissing) {
  EXPECT_THAT(AssembleShader("broken.frag", "", kSources).message(),
              HasSubstr("broken.frag:2: absent.glsl: there is no such shader file"));
  EXPECT_FALSE(AssembleShader("nothing.frag", "", kSources).ok());
}

TEST(ShaderSource, EndsWhereAFileIncludesItself) {
  EXPECT_TRUE(AssembleShader("cycle.glsl", "", kSources).ok());
}

}  // namespace
}  // namespace lararium::render
