// Writes a manual page (man, roff) from a program's description.
#pragma once

#include <string>
#include <vector>

namespace tacipc {

/// An option as the page lists it.
struct ManOption {
  std::string flags;     // "-h,--help"
  std::string argument;  // "PATH …", or empty
  std::string help;
  std::string note;  // "required", "default: 4", or empty
};

/// A section with a title.
struct ManSection {
  std::string title;
  std::vector<std::string> paragraphs;
};

/// Contents of a page.
struct ManPage {
  std::string name;     // name of the page: "tacipc-press"
  std::string command;  // command as typed: "tacipc press"
  std::string version;
  std::string summary;
  std::vector<ManOption> options;
  std::vector<ManSection> sections;  // sections after the options
};

/// Returns the page as roff, for `man -l` or share/man/man1.
std::string to_roff(const ManPage& page);

}  // namespace tacipc
