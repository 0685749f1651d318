#include "common/stage/man_page.h"

#include <fmt/core.h>

namespace tacipc {
namespace {

/// Escapes text, so that roff finds no request or escape in it.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

/// Quotes an argument of a roff request.
std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : plain(text)) out += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::string to_roff(const ManPage& page) {
  std::string upper;
  for (const char c : page.name) upper += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  // No date, so that the same program gives the same bytes.
  std::string roff =
      fmt::format(".TH {} 1 \"\" {} \"TacIPC\"\n", in_quotes(upper), in_quotes("TacIPC " + page.version));
  roff += fmt::format(".SH NAME\n{} \\- {}\n", plain(page.name), plain(page.summary));
  roff += fmt::format(".SH SYNOPSIS\n.B {}\n", plain(page.command));
  for (const ManOption& option : page.options) {
    if (option.note == "required") roff += fmt::format(".B {}\n.I {}\n", plain(option.flags), plain(option.argument));
  }
  roff += "[\\fIoptions\\fR]\n";
  if (!page.options.empty()) roff += ".SH OPTIONS\n";
  for (const ManOption& option : page.options) {
    roff += fmt::format(".TP\n\\fB{}\\fR", plain(option.flags));
    if (!option.argument.empty()) roff += fmt::format(" \\fI{}\\fR", plain(option.argument));
    roff += fmt::format("\n{}{}\n", plain(option.help), option.note.empty() ? "" : plain(" (" + option.note + ")"));
  }
  for (const ManSection& section : page.sections) {
    roff += fmt::format(".SH {}\n", in_quotes(section.title));
    for (std::size_t i = 0; i < section.paragraphs.size(); ++i)
      roff += fmt::format("{}{}\n", i > 0 ? ".PP\n" : "", plain(section.paragraphs[i]));
  }
  return roff;
}

}  // namespace tacipc
