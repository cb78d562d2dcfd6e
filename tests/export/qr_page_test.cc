#include "editor/export/qr_page.h"

#include <gmock/gmock.h>

namespace lararium::exporter {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(QrPage, SaysWhatToDoInTheShowsLanguages) {
  const std::vector<std::string> languages = {"it", "en-GB", "xx", "de"};
  const auto page =
      MakeQrPage("Morning <at> \"the\" bar & more", "https://x.example/?a=1&b", languages);
  ASSERT_TRUE(page.ok()) << page.message();
  EXPECT_THAT(*page, HasSubstr("<html lang=\"it\">"));
  EXPECT_THAT(*page, HasSubstr("<h1>Morning &lt;at&gt; &quot;the&quot; bar &amp; more</h1>"));
  EXPECT_THAT(*page, HasSubstr("<code>https://x.example/?a=1&amp;b</code>"));
  const size_t italian = page->find("<p lang=\"it\">");
  const size_t english = page->find("<p lang=\"en\">");
  const size_t german = page->find("<p lang=\"de\">");
  EXPECT_TRUE(italian < english && english < german && german != std::string::npos);
  EXPECT_EQ(page->find("<p lang=\"en\">", english + 1), std::string::npos) << "said once";
  EXPECT_THAT(*MakeQrPage("a", "https://x.example", {}),
              AllOf(HasSubstr("<html lang=\"en\">"), HasSubstr("people of the past stand here")));
}

TEST(QrPage, AnAddressThatNoCodeHoldsIsAnError) {
  EXPECT_THAT(MakeQrCodeSvg("https://x.example/" + std::string(3000, 'a')).message(),
              AllOf(HasSubstr("too long for a code"), HasSubstr("; ")));
  const auto small = MakeQrCodeSvg("https://x.example");
  const auto large = MakeQrCodeSvg("https://x.example/" + std::string(200, 'a'));
  ASSERT_TRUE(small.ok() && large.ok());
  EXPECT_THAT(*small, HasSubstr("viewBox=\"0 0 33 33\"")) << "25 modules and the border";
  EXPECT_GT(large->size(), 4 * small->size());
}

}  // namespace
}  // namespace lararium::exporter
