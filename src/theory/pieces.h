/// The materials that a scene's body is made of, and what bounds their tensors everywhere.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "theory/tensor_bounds.h"

namespace thermocontact::theory {

/// Cells of one material.
struct Piece {
    std::string region;  ///< its name; of the scene's defaults, those of all regions that have them
    std::vector<std::int32_t> cells;
    std::optional<scene::Material> material;
    std::optional<scene::Heat> heat;
    std::optional<Bounds> elasticity, viscosity;  ///< of laws of a file where they are sampled
};

/// Those that have cells: one where no region differs from the defaults. Throws SceneError where a law file's
/// tensor cannot be one.
std::vector<Piece> pieces_of(const scene::Scene& scene, const mesh::Mesh& mesh);

/// A number over all pieces, and the piece that decides it.
struct Extreme {
    double value = 0;
    std::string where;  ///< " in bush"; empty where all pieces have that number
};

using OfPiece = std::function<double(const Piece&)>;

Extreme smallest(const std::vector<Piece>& pieces, const OfPiece& value);
Extreme largest(const std::vector<Piece>& pieces, const OfPiece& value);

/// Whether elasticity, or conductivity, is present and elliptic in every piece: (H2 i), (H3 ii).
bool elasticity_elliptic(const std::vector<Piece>& pieces);
bool conductivity_elliptic(const std::vector<Piece>& pieces);

}  // namespace thermocontact::theory
