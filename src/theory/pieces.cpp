#include "theory/pieces.h"

#include <algorithm>

#include "model/law_samples.h"
#include "model/pieces.h"

namespace thermocontact::theory {
namespace {

Extreme at(const std::vector<Piece>& pieces, std::vector<Piece>::const_iterator piece, const OfPiece& value) {
    const double extreme = value(*piece);
    const bool everywhere =
        std::ranges::all_of(pieces, [&](const Piece& other) { return value(other) == extreme; });
    return {extreme, everywhere ? "" : " in " + piece->region};
}

std::optional<Bounds> bounds_over(const scene::Scene& scene, const mesh::Mesh& mesh,
                                  const std::optional<scene::VoigtTensor>& tensor, const std::string& form,
                                  const std::vector<std::int32_t>& cells) {
    if (!tensor) {
        return std::nullopt;
    }
    if (!tensor->own) {
        return bounds_of(*tensor, scene.dimension);
    }
    const model::TensorRange range = model::range_of_own_tensor(scene, mesh, form, cells);
    return Bounds{range.smallest, range.largest};
}

/// The regions whose laws are the scene's defaults.
std::string default_regions(const scene::Scene& scene, const mesh::Mesh& mesh) {
    std::string names;
    for (const std::string& name : mesh.region_names) {
        if (!scene.regions.contains(name)) {
            names += (names.empty() ? "" : ", ") + name;
        }
    }
    return names.empty() ? "no region" : names;
}

}  // namespace

std::vector<Piece> pieces_of(const scene::Scene& scene, const mesh::Mesh& mesh) {
    std::vector<Piece> pieces;
    for (auto& [region, cells] : model::cells_by_laws(scene, mesh)) {
        const auto own = scene.regions.find(region);
        const bool is_default = own == scene.regions.end();
        pieces.push_back({is_default ? default_regions(scene, mesh) : region,
                          cells,
                          is_default ? scene.material : own->second.material,
                          is_default ? scene.heat : own->second.heat,
                          {},
                          {}});
        Piece& piece = pieces.back();
        if (piece.material) {
            piece.elasticity = bounds_over(scene, mesh, piece.material->elasticity, "E", cells);
            piece.viscosity = bounds_over(scene, mesh, piece.material->viscosity, "Visc", cells);
        }
    }
    return pieces;
}

Extreme smallest(const std::vector<Piece>& pieces, const OfPiece& value) {
    return at(pieces, std::ranges::min_element(pieces, {}, value), value);
}

Extreme largest(const std::vector<Piece>& pieces, const OfPiece& value) {
    return at(pieces, std::ranges::max_element(pieces, {}, value), value);
}

bool elasticity_elliptic(const std::vector<Piece>& pieces) {
    return std::ranges::all_of(
        pieces, [](const Piece& piece) { return piece.elasticity && piece.elasticity->smallest > 0; });
}

bool conductivity_elliptic(const std::vector<Piece>& pieces) {
    return std::ranges::all_of(pieces, [](const Piece& piece) {
        return piece.heat && piece.heat->conductivity && bounds_of(*piece.heat->conductivity).smallest > 0;
    });
}

}  // namespace thermocontact::theory
