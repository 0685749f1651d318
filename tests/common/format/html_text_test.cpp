#include "common/format/html_text.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace html_text_test {

TEST(HtmlText, LeavesNothingThatCouldBeMarkup) {
  EXPECT_EQ(html_text("<b a=\"x\" c='y'>&amp;</b>"), "&lt;b a=&quot;x&quot; c=&#39;y&#39;&gt;&amp;amp;&lt;/b&gt;");
  EXPECT_EQ(html_text("µm, plain"), "µm, plain");
}

}  // namespace html_text_test
}  // namespace tacipc
