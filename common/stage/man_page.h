// A manual page (man, roff) from what a program says of itself.
#pragma once

#include <string>
#include <vector>

namespace tacipc {

struct ManOption {
  std::string flags;     // "-h,--help"
  std::string argument;  // "PATH …", or empty
  std::string help;
  std::string note;  // "required", "default: 4", or empty
};

struct ManSection {
  std::string title;
  std::vector<std::string> paragraphs;
};

struct ManPage {
  std::string name;     // of the page: "tacipc-press"
  std::string command;  // what one types: "tacipc press"
  std::string version;
  std::string summary;
  std::vector<ManOption> options;
  std::vector<ManSection> sections;  // behind the options
};

/// The page as roff, for `man -l` or share/man/man1.
std::string to_roff(const ManPage& page);

}  // namespace tacipc
