#include "common/stage/man_page.h"

#include <gmock/gmock.h>

namespace tacipc {
namespace man_page_test {

using ::testing::HasSubstr;

TEST(ManPage, SaysNameOptionsAndSections) {
  const std::string roff = to_roff({.name = "tacipc-press",
                                    .command = "tacipc press",
                                    .version = "1.2",
                                    .summary = "Press it.",
                                    .options = {{"--out", "DIR", "folder", "required"}, {"-h,--help", "", "help", ""}},
                                    .sections = {{"FILES", {"One.", "Two."}}}});
  EXPECT_EQ(roff,
            ".TH \"TACIPC\\-PRESS\" 1 \"\" \"TacIPC 1.2\" \"TacIPC\"\n"
            ".SH NAME\ntacipc\\-press \\- Press it.\n"
            ".SH SYNOPSIS\n.B tacipc press\n.B \\-\\-out\n.I DIR\n[\\fIoptions\\fR]\n"
            ".SH OPTIONS\n"
            ".TP\n\\fB\\-\\-out\\fR \\fIDIR\\fR\nfolder (required)\n"
            ".TP\n\\fB\\-h,\\-\\-help\\fR\nhelp\n"
            ".SH \"FILES\"\nOne.\n.PP\nTwo.\n");
}

TEST(ManPage, TextIsNoRequestOfRoff) {
  const std::string roff = to_roff({.name = "a",
                                    .command = "a",
                                    .version = "",
                                    .summary = "s",
                                    .options = {},
                                    .sections = {{"\"X\"", {".so /etc/passwd\n'a \\fB b"}}}});
  EXPECT_THAT(roff, HasSubstr(".SH \"\\(dqX\\(dq\"\n\\&.so /etc/passwd\n\\&'a \\efB b\n"));
}

}  // namespace man_page_test
}  // namespace tacipc
