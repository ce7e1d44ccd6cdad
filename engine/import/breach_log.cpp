#include "engine/import/breach_log.h"

namespace lamina::engine {

void BreachLog::note(std::string_view what, std::string_view section, std::size_t line,
                     std::string_view detail) {
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] != what) continue;
    ++breaches_[i].count;
    return;
  }
  kinds_.push_back(what);
  std::string text(what);
  if (!detail.empty()) text.append(": ").append(detail);
  breaches_.push_back({std::move(text), std::string(section), line, 1});
}

}  // namespace lamina::engine
