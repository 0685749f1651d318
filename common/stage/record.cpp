#include "common/stage/record.h"

#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/base/parse.h"

namespace tacipc {

Record Record::from_file(const std::filesystem::path& path) {
  return {ConfigReader::from_file(path), path.lexically_normal().string(), ""};
}

std::string Record::place(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

void Record::refuse(const std::string& key, const std::string& reason) const {
  throw DataError("{}: {}: {}", file_, place(key), reason);
}

Record Record::section(const std::string& key) const {
  if (!has(key)) return {std::nullopt, file_, place(key)};
  ConfigReader reader = *reader_;
  return {reader.optional_section(key), file_, place(key)};
}

std::vector<Record> Record::sections(const std::string& key) const {
  std::vector<Record> records;
  if (!has(key)) return records;
  ConfigReader reader = *reader_;
  for (ConfigReader& item : reader.sections(key))
    records.push_back({std::move(item), file_, place(fmt::format("{}[{}]", key, records.size()))});
  return records;
}

std::vector<Record> Record::one_or_many(const std::string& key) const {
  std::vector<Record> records = sections(key);
  if (records.empty() && has(key)) records.push_back(section(key));
  return records;
}

std::optional<std::string> Record::text(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  ConfigReader reader = *reader_;
  const std::string value = reader.text(key);
  if (value.empty()) return std::nullopt;
  return value;
}

std::optional<double> Record::number(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  const std::string digits = text(key).value_or("");
  const auto value = parse_number<double>(digits);
  if (!value || !std::isfinite(*value)) refuse(key, fmt::format("expected a number, found '{}'", digits));
  return value;
}

std::optional<int> Record::count(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  const std::string digits = text(key).value_or("");
  const auto value = parse_number<int>(digits);
  if (!value || *value < 0) refuse(key, fmt::format("expected a whole number from 0, found '{}'", digits));
  return value;
}

std::optional<bool> Record::flag(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  const std::string word = text(key).value_or("");
  if (word != "true" && word != "false") refuse(key, fmt::format("expected true or false, found '{}'", word));
  return word == "true";
}

std::vector<std::string> Record::texts(const std::string& key) const {
  if (!has(key)) return {};
  ConfigReader reader = *reader_;
  if (!reader.is_list(key)) refuse(key, "expected a list");
  return reader.texts(key);
}

std::optional<std::vector<double>> Record::numbers(const std::string& key, std::size_t how_many) const {
  if (!has(key)) return std::nullopt;
  ConfigReader reader = *reader_;
  // The reader replaces an invalid value by the fallback, which no record contains.
  auto values = reader.numbers_or(key, std::vector<double>(how_many, std::numeric_limits<double>::quiet_NaN()));
  for (const double value : values) {
    if (!std::isfinite(value)) refuse(key, fmt::format("expected a list of {} numbers", how_many));
  }
  return values;
}

std::optional<std::pair<double, double>> Record::range(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  if (!reader_->is_list(key)) {
    const double value = required_number(key);
    return std::pair(value, value);
  }
  const auto ends = numbers(key, 2);
  return std::pair((*ends)[0], (*ends)[1]);
}

}  // namespace tacipc
