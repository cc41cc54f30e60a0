/// A scene as plain, validated data: everything a run needs to know, nothing about how it is computed.
/// An optional that is empty is physics that is not modelled.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/kernel_table.h"
#include "scene/expression.h"

namespace thermocontact::mesh {
struct Mesh;
}

namespace thermocontact::scene {

/// Along one axis, the largest cell's size over that of the cell at the lower and the upper side (>= 1); 1 at
/// both: uniform. mesh/grading.h defines the points.
struct Grading {
    double lower = 1, upper = 1;
};

/// How the mesh adapts to the solution.
struct Refinement {
    double tolerance;  ///< of the estimated error in space, relative
    int every;         ///< steps between looks at the mesh
    int max_cells;
    int max_level;  ///< bisections of a cell of the scene's mesh
};

struct MeshSpec {
    std::string shape;             ///< "rectangle" | "box"; empty: `file` says
    std::vector<double> lower;     ///< [d], m
    std::vector<double> upper;     ///< [d], m
    std::vector<int> cells;        ///< [d]
    std::string diagonal;          ///< "right" | "left" | "crossed", for rectangles of simplices
    std::string cell = "simplex";  ///< "simplex" | "tensor"
    std::shared_ptr<const mesh::Mesh> file = {};  ///< the mesh of a file, as read; empty: a shape
    std::vector<Grading> grading = {};            ///< [d]; empty: uniform
    std::optional<Refinement> refinement = {};    ///< of simplices; empty: the mesh stays
};

struct TimeSpec {
    double end;          ///< s
    int steps;           ///< number of uniform steps
    std::string scheme;  ///< "backward-euler" | "bdf2" | "midpoint" | "generalized-alpha"
    std::optional<double> spectral_radius = {};     ///< of a second-order scheme; empty: backward Euler
    std::optional<double> coupling_tolerance = {};  ///< of the iterated coupling, relative; empty: lagged
    std::optional<double> tolerance = {};           ///< of adaptive steps, relative; empty: equal steps
};

/// The constants of a law by the names that its kernels give them: "c_n" of a built-in law, "compliance.c" of
/// a scene's file.
struct Law {
    std::map<std::string, double> constants;
    std::string file = {};       ///< empty: built-in
    int line = 0;                ///< of the law in the file
    std::string width = {};      ///< the constant that continuation widens; empty: none
    std::string width_key = {};  ///< its key below the law's table
};

/// Fourth-order tensor in Voigt form, engineering shear: stress = C (e_xx, e_yy, 2 e_xy), row-major [s][s]; s
/// = 3 in 2D (xx, yy, xy) and 6 in 3D (xx, yy, zz, yz, xz, xy). `out_of_plane` [s] gives sigma_zz for plane
/// strain (zero otherwise, empty in 3D).
struct VoigtTensor {
    std::vector<double> matrix;
    std::vector<double> out_of_plane;
    std::optional<Law> own = {};  ///< of a law file, which may depend on the place; then both are empty
};

/// Symmetric second-order tensor, row-major [d][d]; `out_of_plane` is its zz component (plane strain, else
/// 0).
struct SymmetricTensor {
    std::vector<double> matrix;
    double out_of_plane = 0;
};

struct Material {
    std::optional<double> density;          ///< kg/m^3; absent: quasi-static
    std::optional<VoigtTensor> elasticity;  ///< Pa
    std::optional<VoigtTensor> viscosity;   ///< Pa s
};

struct Heat {
    std::optional<double> capacity;                           ///< J/(m^3 K)
    std::optional<SymmetricTensor> conductivity;              ///< W/(m K)
    std::optional<Expression> source;                         ///< W/m^3
    std::optional<SymmetricTensor> thermal_stress;            ///< M, Pa/K
    std::optional<SymmetricTensor> strain_heating;            ///< R, W/m^3 (per unit strain)
    std::optional<SymmetricTensor> strain_rate_heating = {};  ///< of the strain rate, J/m^3
    std::optional<Law> own_source = {};                       ///< of a law file, in place of `source`
};

/// What one named region of the mesh is made of: the scene's defaults with the region's own numbers over
/// them.
struct Region {
    std::optional<Material> material;
    std::optional<Heat> heat;
};

struct Initial {
    std::vector<Expression> displacement;   ///< [d] m; empty: zero
    std::vector<Expression> velocity;       ///< [d] m/s; empty: zero
    std::optional<Expression> temperature;  ///< K; empty: zero
};

struct Friction {
    Law law;                ///< mu
    double regularisation;  ///< epsilon, m/s
    double heat_share =
        0;  ///< of what friction dissipates, that heats the body; the foundation takes the rest
};

struct Conductance {
    Law law;                            ///< k_c, W/(m^2 K), eps_c, m, L, K
    Expression foundation_temperature;  ///< theta_F, K
};

struct Contact {
    Expression gap;      ///< initial gap g, m
    int quadrature = 4;  ///< degree of the Gauss rule on facets; 0: the rule at the facet's nodes ("vertex")
    std::vector<Expression> foundation_velocity =
        {};                         ///< [d] m/s, its tangential part counts; size 0: at rest
    std::optional<Law> compliance;  ///< c_n, Pa/m^m, m in p_n(r) = c_n r_+^m
    std::optional<Friction> friction;
    std::optional<Conductance> conductance;
};

/// Heat exchange with the surroundings, q.n = h (theta - theta_a).
struct Convection {
    double coefficient;              ///< h, W/(m^2 K)
    Expression ambient_temperature;  ///< theta_a, K
};

/// An elastic support, sigma n = -k_s (u - u_s).
struct Spring {
    SymmetricTensor stiffness;       ///< k_s, N/m^3
    std::vector<Expression> anchor;  ///< [d] u_s, m; size 0: fixed
};

struct Boundary {
    std::vector<std::optional<Expression>>
        displacement;                  ///< [d] m, empty component: free; size 0: not prescribed
    std::vector<Expression> traction;  ///< [d] Pa; size 0: none
    std::optional<Spring> spring;
    std::optional<Expression> temperature;  ///< K
    std::optional<Expression> heat_flux;    ///< W/m^2 into the body
    std::optional<Convection> convection;
    std::optional<Contact> contact;
};

struct SolverSpec {
    std::string strategy;  ///< "auto" | "condensed" | "newton-krylov"
    double tolerance;      ///< relative, of each nonlinear solve
    int max_iterations;    ///< of one Newton solve
    std::string factor;    ///< "auto" | "double" | "single"
};

struct OutputSpec {
    int every;                                 ///< steps between field outputs
    std::vector<std::string> fields;           ///< subset of the names in `output_fields`
    std::optional<int> checkpoint_every = {};  ///< steps between checkpoints; empty: as often as is cheap
};

using KernelTable = std::span<const thermocontact_kernel>;

struct Scene {
    std::string title;
    std::filesystem::path path;
    int dimension = 2;
    int degree = 1;
    MeshSpec mesh;
    TimeSpec time;
    std::optional<Material> material;
    std::optional<Heat> heat;
    std::map<std::string, Region> regions;  ///< those that differ from the defaults
    std::vector<Expression> body_force;     ///< [d] N/m^3; size 0: none
    std::optional<Law> own_body_force;      ///< of a law file, in place of it
    Initial initial;
    std::map<std::string, Boundary> boundaries;
    SolverSpec solver;
    OutputSpec output;
    KernelTable kernels = {};                      ///< of law files: they come before the linked ones
    std::map<std::string, std::string> laws = {};  ///< digest of each law file, by kind
    nlohmann::ordered_json resolved;               ///< every key that is in force, defaults included
};

}  // namespace thermocontact::scene
