#include "stages/gel/press/contact/gels_search.h"

#include <algorithm>

#include "stages/gel/press/contact/search_tools.h"
#include "stages/gel/press/contact/surface_pairs.h"

namespace tacipc {
namespace {

Surface shifted(Surface surface, int by) {
  for (int& v : surface.vertices) v += by;
  for (auto& edge : surface.edges) {
    for (int& v : edge) v += by;
  }
  for (auto& triangle : surface.triangles) {
    for (int& v : triangle) v += by;
  }
  return surface;
}

void shift(std::vector<ContactPair>& pairs, std::size_t first, int by) {
  for (std::size_t i = first; i < pairs.size(); ++i) {
    for (int& v : pairs[i].vertices) v += by;
  }
}

auto own_rows(const GelPart& part, const Positions& rows) {
  return rows.middleRows(part.first_vertex, part.mesh->num_gel_vertices);
}

}  // namespace

GelsSearch::GelsSearch(const ContactMesh& mesh)
    : mesh_(mesh), turns_(mesh.gels.size(), Matrix3::Identity()), frames_(mesh.gels.size()) {
  if (mesh.gels.empty()) each_.push_back(std::make_unique<SelfSearch>(mesh));
  for (const GelPart& gel : mesh.gels) {
    each_.push_back(std::make_unique<SelfSearch>(*gel.mesh));
    surfaces_.push_back(shifted(gel.mesh->gel, gel.first_vertex));
  }
}

void GelsSearch::forget() {
  for (const auto& search : each_) search->forget();
}

int GelsSearch::num_searches() const {
  int sum = 0;
  for (const auto& search : each_) sum += search->num_searches();
  return sum;
}

Positions GelsSearch::places(std::size_t gel, const Positions& x) const {
  const GelPart& part = mesh_.gels[gel];
  if (part.anchor < 0) return frames_[gel].places(own_rows(part, x));
  return displacements(gel, x).rowwise() + part.mesh->rest_positions.row(part.anchor);
}

Positions GelsSearch::displacements(std::size_t gel, const Positions& p) const {
  const GelPart& part = mesh_.gels[gel];
  const auto own = own_rows(part, p);
  if (part.anchor < 0) return frames_[gel].displacements(own);
  return (own.rowwise() - own.row(part.anchor)) * turns_[gel];
}

void GelsSearch::pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) {
  if (mesh_.gels.empty()) return each_[0]->pairs(x, p, within_m, out);
  for (std::size_t g = 0; g < each_.size(); ++g) {
    const GelPart& part = mesh_.gels[g];
    const std::size_t before = out.size();
    if (part.anchor < 0) frames_[g] = body_frame(part.mesh->rest_positions, own_rows(part, x) + own_rows(part, p));
    each_[g]->pairs(places(g, x), displacements(g, p), within_m, out);
    shift(out, before, part.first_vertex);
  }
  across(x, p, within_m, out);
}

void GelsSearch::around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x,
                        double within_m, std::vector<ContactPair>& out) {
  if (mesh_.gels.empty()) return each_[0]->around(wanted, reach_m, x, within_m, out);
  for (std::size_t g = 0; g < each_.size(); ++g) {
    const GelPart& part = mesh_.gels[g];
    const auto first = reach_m.begin() + part.first_vertex;
    const std::vector<double> own(first, first + part.mesh->num_gel_vertices);
    const std::size_t before = out.size();
    const auto first_wanted = wanted.begin() + part.first_vertex;
    const std::vector<char> own_wanted(first_wanted, first_wanted + part.mesh->num_gel_vertices);
    each_[g]->around(own_wanted, own, places(g, x), within_m, out);
    shift(out, before, part.first_vertex);
  }
  std::vector<ContactPair> found;
  across(x, Positions::Zero(x.rows(), 3), within_m + 2.0 * *std::max_element(reach_m.begin(), reach_m.end()), found);
  std::copy_if(found.begin(), found.end(), std::back_inserter(out),
               [&](const ContactPair& pair) { return has_one(wanted, pair.vertices); });
}

void GelsSearch::across(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) const {
  for (std::size_t a = 0; a < surfaces_.size(); ++a) {
    for (std::size_t b = a + 1; b < surfaces_.size(); ++b)
      pairs_between(surfaces_[a], surfaces_[b], x, p, within_m, out);
  }
}

}  // namespace tacipc
