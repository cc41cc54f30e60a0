/// A kernel bound to its constants and coefficients, ready to be evaluated on cells or facets.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "fem/kernel.h"
#include "fem/space.h"
#include "mesh/mesh.h"

namespace thermocontact::fem {

/// Values of the constants of forms, row-major, by the name that the form file gives them.
using Constants = std::map<std::string, std::vector<double>>;

/// A field that a coefficient takes its values from: values [nodes][components].
struct Field {
    const std::vector<double>* values;
    int components;
    const Dofmap* dofmap;
};
using Fields = std::map<std::string, Field>;

class Form {
  public:
    /// Binds by name; names that the kernel does not use are ignored. `rule` names the integrals of facet
    /// forms (those everywhere are always taken). Throws std::logic_error for a name that is missing.
    Form(Kernel kernel, const mesh::Mesh& mesh, const Constants& constants, const Fields& fields = {},
         int rule = -1);

    /// The same with constants for each region of the mesh, and last those of cells in no region.
    static Form by_region(Kernel kernel, const mesh::Mesh& mesh, const std::vector<Constants>& sets,
                          const Fields& fields = {}, int rule = -1);

    /// Adds the tensor of one cell to `tensor` (row-major).
    void add_cell(std::int32_t cell, std::span<double> tensor);

    /// Adds the tensor of one facet to `tensor` (row-major).
    void add_facet(const mesh::Facet& facet, std::span<double> tensor);

    /// Changes a scalar constant; nothing happens if the kernel does not use it. Returns whether it had
    /// another value.
    bool set_constant(const std::string& name, double value);

    /// Adds the tensor of one facet to `tensor` (row-major) from `coefficients` [coefficient_count()], cell
    /// by cell as fields() name them, and the vertices of its cell [vertices][3].
    void tabulate(const mesh::Facet& facet, const double* coefficients, const double* vertices,
                  double* tensor) const;

    const std::string& name() const { return kernel_.name; }
    int rank() const { return kernel_.rank; }
    const std::vector<Field>& fields() const { return fields_; }
    std::size_t coefficient_count() const { return coefficients_.size(); }

  private:
    Form(Kernel kernel, const mesh::Mesh& mesh, const Fields& fields, int rule,
         const std::vector<Constants>& sets);

    void gather(std::int32_t cell);
    const double* constants_of(std::int32_t cell) const;

    Kernel kernel_;
    const mesh::Mesh* mesh_;
    std::vector<Tabulate> cell_calls_, facet_calls_;
    std::vector<double> constants_;  ///< [sets][constants_size_]
    std::size_t constants_size_ = 0;
    std::map<std::string, std::size_t> constant_offsets_;
    std::vector<Field> fields_;
    std::vector<double> coefficients_;  ///< of the current cell
    std::vector<double> coordinates_;   ///< of the current cell [vertices][3]
};

}  // namespace thermocontact::fem
