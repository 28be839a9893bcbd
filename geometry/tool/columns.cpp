// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/columns.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::tool {
namespace {

std::string listed(const std::vector<std::string_view>& fields) {
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const bool last = i + 1 == fields.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + std::string(fields[i]);
  }
  return text;
}

std::vector<std::string_view> joined(const std::vector<std::string_view>& a,
                                     const std::vector<std::string_view>& b) {
  std::vector<std::string_view> result = a;
  result.insert(result.end(), b.begin(), b.end());
  return result;
}

std::vector<std::string_view> all_of(const BodyForm& form) {
  return joined(joined(form.place, form.own), form.optional);
}

}  // namespace

tables::Error lacking(const tables::Header& header, std::string_view who,
                      const std::vector<std::string>& missing, std::string_view rule) {
  std::string what = std::string(who) + " without ";
  for (const std::string& name : missing) what += (&name == &missing.front() ? "" : ", ") + name;
  return tables::Error(
      {.file = header.file(), .line = header.line(), .value = what, .rule = std::string(rule)});
}

FormColumns::FormColumns(const tables::Header& header, std::string_view body,
                         std::span<const BodyForm> forms, std::string_view rule)
    : file_(header.file()),
      who_(body.empty() ? std::string("the body") : "body " + std::string(body)),
      prefix_(body.empty() ? std::string() : std::string(body) + '.') {
  find_form(header, forms, rule);
  const BodyForm& form = forms[form_];
  const auto find_all = [&](const std::vector<std::string_view>& fields,
                            std::vector<std::string>& missing) {
    std::vector<tables::Column> found;
    for (const std::string_view field : fields)
      found.push_back(find_columns(header, prefix_, std::array{field}, missing)[0]);
    return found;
  };
  std::vector<std::string> missing;
  fields_ = joined(form.place, form.own);
  columns_ = find_all(fields_, missing);
  if (!missing.empty())
    throw lacking(
        header, who_, missing,
        "a body given by " + std::string(form.name) + " has the columns " + listed(fields_));
  const std::vector<tables::Column> optional = find_all(form.optional, missing);
  if (missing.empty()) {
    fields_ = joined(fields_, form.optional);
    columns_.insert(columns_.end(), optional.begin(), optional.end());
  } else if (missing.size() < form.optional.size()) {
    throw lacking(header, who_, missing,
                  "the columns " + listed(form.optional) + " come all or not at all");
  }
  find_level(header, form.has_level);
}

void FormColumns::find_form(const tables::Header& header, std::span<const BodyForm> forms,
                            std::string_view rule) {
  const auto has = [&](std::string_view field) {
    return header.find(prefix_ + std::string(field)).has_value();
  };
  const auto known = std::ranges::find_if(
      forms, [&](const BodyForm& form) { return std::ranges::any_of(form.own, has); });
  if (known == forms.end()) return;
  form_ = static_cast<std::size_t>(known - forms.begin());
  const std::vector<std::string_view> fields = all_of(*known);
  for (const BodyForm& other : forms) {
    for (const std::string_view field : all_of(other)) {
      if (std::ranges::find(fields, field) != fields.end() || !has(field)) continue;
      const std::string_view own = *std::ranges::find_if(known->own, has);
      throw tables::Error({.file = file_,
                           .line = header.line(),
                           .value = who_ + " with " + prefix_ + std::string(own) + " and " +
                                    prefix_ + std::string(field),
                           .rule = std::string(rule)});
    }
  }
}

void FormColumns::find_level(const tables::Header& header, bool has_level) {
  level_ = header.find(prefix_ + "level");
  confidence_ = header.find(prefix_ + "confidence");
  const auto refuse = [&](tables::Column column, std::string_view rule) {
    throw tables::Error({.file = file_,
                         .line = header.line(),
                         .value = who_ + " with " + header.name(column),
                         .rule = std::string(rule)});
  };
  if (!has_level && (level_ || confidence_))
    refuse(level_ ? *level_ : *confidence_, "a level goes with a shape or precision matrix");
  if (level_ && confidence_) refuse(*confidence_, "a body has a level or a confidence, not both");
}

std::vector<double> FormColumns::numbers(const tables::RowCursor& row) const {
  std::vector<double> result(columns_.size());
  std::ranges::transform(columns_, result.begin(),
                         [&](tables::Column column) { return row.number(column); });
  return result;
}

double FormColumns::level(const tables::RowCursor& row, int dimensions) const {
  if (level_) return row.number(*level_);
  if (!confidence_) return 1.0;
  const double confidence = row.number(*confidence_);
  try {
    return level_of_confidence(confidence, dimensions);
  } catch (const std::invalid_argument& refused) {
    throw row.error(*confidence_, refused.what());
  }
}

tables::Error FormColumns::refused(const tables::RowCursor& row, std::string_view field,
                                   double value, std::string_view rule) const {
  const auto place = std::ranges::find(fields_, field);
  if (place != fields_.end())
    return row.error(columns_[static_cast<std::size_t>(place - fields_.begin())], rule);
  if (field == "level" && level_) return row.error(*level_, rule);
  return tables::Error({.file = file_,
                        .line = row.line(),
                        .column = prefix_ + std::string(field),
                        .value = tables::to_text(value),
                        .rule = std::string(rule)});
}

}  // namespace tangency::inline v0::tool
