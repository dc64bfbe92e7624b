#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rex::authoring::internal {

/// Finds any of many texts at once, by their first letters.
class FormIndex {
 public:
  static constexpr std::size_t kKey = 16;  ///< letters; shorter forms are never found

  void add(std::string form, std::size_t owner) {
    if (form.size() >= kKey) forms_[form.substr(0, kKey)].push_back({std::move(form), owner});
  }

  /// Calls `found` with the owner of each form in the text and the place where it begins.
  void search(std::string_view text, const std::function<void(std::size_t, std::size_t)>& found) const {
    for (std::size_t at = 0; at + kKey <= text.size(); ++at) {
      key_.assign(text.substr(at, kKey));
      const auto candidates = forms_.find(key_);
      if (candidates == forms_.end()) continue;
      for (const Form& form : candidates->second)
        if (text.substr(at).starts_with(form.letters)) found(form.owner, at);
    }
  }

 private:
  struct Form {
    std::string letters;
    std::size_t owner;
  };
  std::unordered_map<std::string, std::vector<Form>> forms_;
  mutable std::string key_;  // spares an allocation per letter
};

}  // namespace rex::authoring::internal
