#include "fem/kernel.h"

#include <ufcx.h>

#include <stdexcept>

namespace thermocontact::fem {
namespace {

#define UFCX_BEFORE(major, minor) \
    (UFCX_VERSION_MAJOR == 0 ? (major) > 0 || UFCX_VERSION_MINOR < (minor) : UFCX_VERSION_MAJOR < (major))

std::vector<Integral> integrals_of(const ufcx_form& form, ufcx_integral_type type) {
    std::vector<Integral> result;
#if UFCX_BEFORE(0, 7)
    const int count = form.num_integrals(type);
    result.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        result.push_back({form.integral_ids(type)[i], form.integrals(type)[i]->tabulate_tensor_float64});
    }
#else
    for (int i = form.form_integral_offsets[type]; i < form.form_integral_offsets[type + 1]; ++i) {
        result.push_back({form.form_integral_ids[i], form.form_integrals[i]->tabulate_tensor_float64});
    }
#endif
    return result;
}

std::vector<std::string> names(const char** list, int count) {
    return {list, list + count};
}

Kernel describe(const std::string& name, const ufcx_form& form) {
#if UFCX_BEFORE(0, 8)
    const char** coefficients = form.coefficient_name_map();
    const char** constants = form.constant_name_map();
#else
    const char** coefficients = form.coefficient_name_map;
    const char** constants = form.constant_name_map;
#endif
    return {name,
            form.rank,
            names(coefficients, form.num_coefficients),
            names(constants, form.num_constants),
            integrals_of(form, cell),
            integrals_of(form, exterior_facet)};
}

}  // namespace

KernelTable linked_kernels() {
    return {thermocontact_kernels, static_cast<std::size_t>(thermocontact_kernel_count)};
}

Kernel find_kernel(const std::string& name, const std::string& cell, int degree, KernelTable table) {
    return kernel_in_force(name, cell, degree, table, {});
}

Kernel kernel_in_force(const std::string& name, const std::string& cell, int degree, KernelTable own,
                       KernelTable others) {
    for (const KernelTable table : {own, others}) {
        for (const thermocontact_kernel& entry : table) {
            if (name == entry.name && cell == entry.cell && degree == entry.degree) {
                return describe(name, **entry.form);
            }
        }
    }
    throw std::logic_error("no kernel " + name + " for " + cell + " of degree " + std::to_string(degree));
}

std::string kernel_provenance() {
    return std::string(thermocontact_kernel_versions) + "; forms " + thermocontact_forms_digest;
}

}  // namespace thermocontact::fem
