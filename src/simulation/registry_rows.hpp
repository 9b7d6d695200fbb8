#pragma once
/// How the registry's table is put down: sections as paths of members from the Scene on, and their keys one by one.
/// Included by the files of the table alone.

#include <fmt/format.h>

#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>

#include "simulation/registry.hpp"

namespace spindrift {

template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

constexpr Range from(double low, double high) {
  return {low, high, false, false};
}
constexpr Range above(double low, double high) {
  return {low, high, true, false};
}
constexpr Range below(double low, double high) {
  return {low, high, false, true};
}
constexpr Range between(double low, double high) {
  return {low, high, true, true};
}

inline constexpr double right_angle = std::numbers::pi / 2;
inline constexpr Range position = from(-1e7, 1e7), extent = above(0, 1e5), speed = from(-1000, 1000),
                       iterations = from(1, 1e6);

/// A list of sections; lists of numbers and points are values.
template <class T>
constexpr bool is_list = false;
template <class T>
constexpr bool is_list<std::vector<T>> = std::is_class_v<T> && !requires {
  typename T::value_type;
};

/// The member at the end of a path of member pointers, through the sections on the way; `index` in a list of them.
template <auto First, auto... Rest, class S>
auto& member(S& owner, std::size_t index) {
  auto& next = owner.*First;
  if constexpr (sizeof...(Rest) == 0) {
    return next;
  } else if constexpr (is_optional<std::remove_cvref_t<decltype(next)>>) {
    return member<Rest...>(*next, index);
  } else if constexpr (is_list<std::remove_cvref_t<decltype(next)>>) {
    return member<Rest...>(next[index], index);
  } else {
    return member<Rest...>(next, index);
  }
}

template <auto First, auto... Rest, class S>
std::size_t count(const S& owner) {
  using T = std::remove_cvref_t<decltype(owner.*First)>;
  if constexpr (is_list<T>) return (owner.*First).size();
  if constexpr (is_optional<T>) {
    if (!(owner.*First)) return 0;
    if constexpr (sizeof...(Rest) > 0) return count<Rest...>(*(owner.*First));
  }
  return 1;
}

template <auto First, auto... Rest, class S>
void create(S& owner) {
  using T = std::remove_cvref_t<decltype(owner.*First)>;
  if constexpr (is_list<T>) (owner.*First).emplace_back();
  if constexpr (is_optional<T>) {
    if (!(owner.*First)) (owner.*First).emplace();
    if constexpr (sizeof...(Rest) > 0) create<Rest...>(*(owner.*First));
  }
}

template <auto First, auto... Rest>
constexpr bool repeats = is_list<std::remove_cvref_t<decltype(std::declval<Scene&>().*First)>>;

struct Registry {
  std::vector<Section> sections;
  std::vector<Key> keys;
};

/// [scene], [domain], [terrain] and [[obstacle]].
void add_setting(Registry& registry);

/// Adds one section, and its keys one by one; Path leads from the Scene to the section.
template <auto... Path>
class Rows {
 public:
  Rows(Registry& registry, std::string_view path, std::string_view doc) : registry_(registry), path_(path) {
    registry.sections.push_back({path, doc, repeats<Path...>, [](const Scene& scene) { return count<Path...>(scene); },
                                 [](Scene& scene) { create<Path...>(scene); }});
  }

  /// The keys that follow mean something only where the section's word `name` is one of `values`.
  Rows& with(std::string_view name, std::vector<std::string_view> values) {
    condition_ = {name, std::move(values)};
    return *this;
  }
  /// The keys that follow mean something whatever else the section says.
  Rows& always() { return with({}, {}); }
  template <auto Member>
  Rows& number(std::string_view name, std::string_view unit, Range range, std::string_view doc,
               std::string_view source = "") {
    return add<Member>(name, unit, range, {}, doc, source);
  }
  /// Numbers along all axes but the upward one.
  template <auto Member>
  Rows& place(std::string_view name, std::string_view doc) {
    add<Member>(name, "m", position, {}, doc, "");
    registry_.keys.back().in_plan = true;
    return *this;
  }
  template <auto Member>
  Rows& words(std::string_view name, std::vector<std::string_view> allowed, std::string_view doc,
              std::string_view source = "") {
    return add<Member>(name, "", {}, std::move(allowed), doc, source);
  }
  template <auto Member>
  Rows& plain(std::string_view name, std::string_view doc, std::string_view source = "") {
    return add<Member>(name, "", {}, {}, doc, source);
  }

 private:
  template <auto Member>
  Rows& add(std::string_view name, std::string_view unit, Range range, std::vector<std::string_view> allowed,
            std::string_view doc, std::string_view source) {
    const auto slot = [](Scene& scene, std::size_t index) -> Slot { return &member<Path..., Member>(scene, index); };
    registry_.keys.push_back(
        {fmt::format("{}.{}", path_, name), unit, range, std::move(allowed), doc, source, condition_, slot});
    return *this;
  }

  Registry& registry_;
  std::string_view path_;
  Condition condition_;
};

/// The part of the table in registry_output.cpp.
void add_output(Registry& registry);

}  // namespace spindrift
