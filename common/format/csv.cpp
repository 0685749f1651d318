#include "common/format/csv.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/base/error.h"
#include "common/base/parse.h"

namespace tacipc {

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += fields[i];
      continue;
    }
    line += '"';
    for (const char c : fields[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + "\n";
}

CsvReader::CsvReader(const std::filesystem::path& path) : name_(path.string()), file_(path, std::ios::binary) {
  if (!file_) throw DataError("{}: cannot be read: {}", name_, std::strerror(errno));
  auto names = read_row();
  if (!names) throw DataError("{}: has no line of column names", name_);
  columns_ = std::move(*names);
}

std::optional<std::vector<std::string>> CsvReader::read_row() {
  std::string line;
  if (!std::getline(file_, line)) return std::nullopt;
  ++line_;
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0;; ++i) {
    if (i == line.size() && quoted) {
      std::string more;
      if (!std::getline(file_, more)) throw DataError("{}:{}: unterminated quote", name_, line_);
      ++line_;
      line += '\n';
      line += more;
    }
    if (i == line.size()) break;
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (quoted || c != '\r' || i + 1 != line.size()) {
      fields.back() += c;
    }
  }
  return fields;
}

bool CsvReader::next() {
  auto fields = read_row();
  if (!fields) {
    if (file_.bad()) throw DataError("{}: cannot be read: {}", name_, std::strerror(errno));
    return false;
  }
  if (fields->size() != columns_.size())
    throw DataError("{}:{}: {} fields, but there are {} columns", name_, line_, fields->size(), columns_.size());
  row_ = std::move(*fields);
  return true;
}

const std::string& CsvReader::operator[](std::string_view column) const {
  const auto found = std::ranges::find(columns_, column);
  if (found == columns_.end()) throw DataError("{}: has no column '{}'", name_, column);
  return row_[found - columns_.begin()];
}

double CsvReader::number(std::string_view column) const {
  const std::string& field = (*this)[column];
  const auto value =
      parse_number<double>(std::string_view(field).substr(std::min(field.find_first_not_of(' '), field.size())));
  if (!value) throw DataError("{}:{}: {}: '{}' is not a number", name_, line_, column, field);
  return *value;
}

}  // namespace tacipc
