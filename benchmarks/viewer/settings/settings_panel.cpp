#include "benchmarks/viewer/settings/settings_panel.h"

#include "benchmarks/viewer/settings/field_widgets.h"

namespace benchmarks {

Edit settingsPanel(
    hair::Settings& settings, const hair::Settings& original, const std::string& search) {
    FieldWidgets widgets(search);
    widgets.showAll(settings, original);
    return widgets.edit();
}

}  // namespace benchmarks
