#include "theory/pieces.h"

#include <algorithm>

#include "model/pieces.h"

namespace thermocontact::theory {
namespace {

Extreme at(const std::vector<Piece>& pieces, std::vector<Piece>::const_iterator piece, const OfPiece& value) {
    const double extreme = value(*piece);
    const bool everywhere =
        std::ranges::all_of(pieces, [&](const Piece& other) { return value(other) == extreme; });
    return {extreme, everywhere ? "" : " in " + piece->region};
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
        pieces.push_back({is_default ? default_regions(scene, mesh) : region, cells,
                          is_default ? scene.material : own->second.material,
                          is_default ? scene.heat : own->second.heat});
    }
    return pieces;
}

Extreme smallest(const std::vector<Piece>& pieces, const OfPiece& value) {
    return at(pieces, std::ranges::min_element(pieces, {}, value), value);
}

Extreme largest(const std::vector<Piece>& pieces, const OfPiece& value) {
    return at(pieces, std::ranges::max_element(pieces, {}, value), value);
}

bool elasticity_elliptic(const std::vector<Piece>& pieces, int dimension) {
    return std::ranges::all_of(pieces, [dimension](const Piece& piece) {
        return piece.material && piece.material->elasticity &&
               bounds_of(*piece.material->elasticity, dimension).smallest > 0;
    });
}

bool conductivity_elliptic(const std::vector<Piece>& pieces) {
    return std::ranges::all_of(pieces, [](const Piece& piece) {
        return piece.heat && piece.heat->conductivity && bounds_of(*piece.heat->conductivity).smallest > 0;
    });
}

}  // namespace thermocontact::theory
