#include "plan/orders.h"

namespace thermocontact::plan {

std::vector<double> highest_in_space(const std::vector<std::string>& components, int degree) {
    std::vector<double> orders;
    for (const std::string& component : components) {
        orders.push_back(component == "strain" ? degree : degree + 1);
    }
    return orders;
}

std::vector<double> highest_in_time(const std::vector<std::string>& components, const Stepping& stepping) {
    const double order = stepping.scheme == "backward-euler" ? 1 : 2;
    return std::vector<double>(components.size(), stepping.adaptive ? order / (order + 1) : order);
}

}  // namespace thermocontact::plan
