#pragma once
/// The schema's building blocks: a field knows its key, unit, rule and documentation, and where its value
/// goes. The documented default is that of the member itself.

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/config_reader.h"
#include "value.h"

namespace cfem_cutting {

template <typename Target>
struct Field {
  KeyDoc doc;
  std::function<void(const Value&, Target&)> read;
  std::vector<KeyDoc> children;  ///< of a list's items
};

template <typename Target>
using Fields = std::vector<Field<Target>>;

/// The value a member has by default.
template <typename Target, typename Member>
auto default_of(const Member& member) {
  Target target{};
  return std::decay_t<decltype(member(target))>(member(target));
}

/// Reads a value of the member's type that obeys the rule.
/// @param member returns a reference into the target
template <typename Target, typename Member, typename T>
Field<Target> field(const std::string& key, const std::string& unit, const Rule<T>& rule, Member member,
                    const std::string& description) {
  const KeyDoc doc{key, format(default_of<Target>(member)), unit, rule.text, description};
  const auto read = [rule, member](const Value& value, Target& target) {
    T read_value{};
    if (!parse(value.node, read_value) || !rule.holds(read_value)) refuse(value, rule.text);
    member(target) = std::move(read_value);
  };
  return {doc, read, {}};
}

/// A field that has to be given.
template <typename Target>
Field<Target> required(Field<Target> field) {
  field.doc.default_value = "required";
  return field;
}

/// A value that is checked but not used yet.
template <typename Target>
Field<Target> checked_only(const std::string& key, const std::string& unit, const Rule<double>& rule,
                           const std::string& description) {
  const auto read = [rule](const Value& value, Target&) {
    double number;
    if (!parse(value.node, number) || !rule.holds(number)) refuse(value, rule.text);
  };
  return {{key, "none", unit, rule.text, description}, read, {}};
}

/// One word of several, each of which stands for a value of the member.
template <typename Target, typename Member, typename T>
Field<Target> choice(const std::string& key, const std::vector<std::pair<std::string, T>>& words,
                     Member member, const std::string& description) {
  std::string rule, default_word;
  for (const auto& [word, meaning] : words) {
    rule += (rule.empty() ? "" : " or ") + word;
    if (meaning == default_of<Target>(member)) default_word = word;
  }
  const auto read = [words, rule, member](const Value& value, Target& target) {
    for (const auto& [word, meaning] : words)
      if (value.node.IsScalar() && value.node.Scalar() == word) return void(member(target) = meaning);
    refuse(value, rule);
  };
  return {{key, default_word, "", rule, description}, read, {}};
}

/// Reads a mapping by the fields; sections (`a.b`) are mappings in mappings.
/// @param prefix key of the mapping with a trailing dot, or empty
/// @throw ConfigError unknown or repeated key, wrong type, value out of range
template <typename Target>
void read_mapping(const Fields<Target>& fields, const YAML::Node& node, const std::string& prefix,
                  Target& target);

/// A list of mappings that replaces the default one.
/// @param check called with each item and its key, throws ConfigError
template <typename Target, typename Item, typename Member, typename Check>
Field<Target> list(const std::string& key, const Fields<Item>& fields, const std::string& default_value,
                   const Rule<std::vector<Item>>& rule, Member member, Check check,
                   const std::string& description) {
  const auto read = [=](const Value& value, Target& target) {
    if (!value.node.IsSequence()) refuse(value, rule.text);
    std::vector<Item> items;
    for (const YAML::Node& node : value.node) {
      const std::string item_key = value.key + "[" + std::to_string(items.size()) + "]";
      if (!node.IsMap()) refuse({item_key, node}, "a mapping");
      items.emplace_back();
      read_mapping(fields, node, item_key + ".", items.back());
      check(Value{item_key, node}, items.back());
    }
    if (!rule.holds(items)) refuse(value, rule.text);
    member(target) = std::move(items);
  };
  Field<Target> result{{key, default_value, "", rule.text, description}, read, {}};
  for (const Field<Item>& item : fields) {
    result.children.push_back(item.doc);
    result.children.back().key = key + "[]." + item.doc.key;
  }
  return result;
}

/// The fields of a part of the target, under a section.
template <typename Target, typename Part, typename Member>
void add_section(Fields<Target>& fields, const std::string& section, const Fields<Part>& parts,
                 Member member) {
  for (const Field<Part>& part : parts) {
    Field<Target> whole{part.doc, nullptr, part.children};
    whole.doc.key = section + "." + part.doc.key;
    for (KeyDoc& child : whole.children) child.key = section + "." + child.key;
    whole.read = [read = part.read, member](const Value& value, Target& target) {
      read(value, member(target));
    };
    fields.push_back(std::move(whole));
  }
}

/// "; did you mean …?" for a key that resembles a known one, else empty.
std::string suggestion(const std::string& key, const std::vector<std::string>& known);

/// Of the fields and of the sections that they are in.
template <typename Target>
std::vector<std::string> keys_of(const Fields<Target>& fields) {
  std::vector<std::string> keys;
  for (const Field<Target>& field : fields) {
    const std::string& key = field.doc.key;
    for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1))
      keys.push_back(key.substr(0, dot));
    keys.push_back(key);
  }
  return keys;
}

template <typename Target>
void read_entries(const Fields<Target>& fields, const YAML::Node& node, const std::string& prefix,
                  const std::string& section, Target& target) {
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const std::string path = section + (entry.first.IsScalar() ? entry.first.Scalar() : "?");
    const Value value{prefix + path, entry.second};
    if (!seen.insert(path).second) throw ConfigError(value.key + ": is given twice");
    const Field<Target>* found = nullptr;
    bool is_section = false;
    for (const Field<Target>& field : fields) {
      if (field.doc.key == path) found = &field;
      is_section |= field.doc.key.compare(0, path.size() + 1, path + ".") == 0;
    }
    if (found) {
      found->read(value, target);
    } else if (is_section) {
      if (!value.node.IsMap() && !value.node.IsNull()) refuse(value, "a mapping");
      read_entries(fields, value.node, prefix, path + ".", target);
    } else {
      throw ConfigError(value.key + ": unknown key" + suggestion(path, keys_of(fields)));
    }
  }
}

template <typename Target>
void read_mapping(const Fields<Target>& fields, const YAML::Node& node, const std::string& prefix,
                  Target& target) {
  read_entries(fields, node, prefix, "", target);
}

}  // namespace cfem_cutting
