// Outlines in the plane of the face and the signed distance to them: metres, x right, y up, positive inside.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace tacipc {

using Vector2 = Eigen::Vector2d;
using Points2 = std::vector<Vector2>;

/// Signed distance to the raised region, m: positive inside, exact next to the outline.
using Distance = std::function<double(const Vector2&)>;

/// Distance from p to the segment ab (to the point a if both ends are the same).
double segment_distance(const Vector2& p, const Vector2& a, const Vector2& b);

/// Signed distance to a closed polygon that does not cross itself: least distance to its edges, positive where the
/// winding number is odd. Either orientation.
/// \pre at least 3 corners
double polygon_distance(const Points2& corners, const Vector2& p);

/// Corners of a regular polygon, the first one straight up, counter-clockwise, turned by `turn_rad`.
Points2 regular_polygon(int sides, double radius_m, double turn_rad);
/// A star: `points` tips on the outer circle, notches on the inner one, first tip straight up.
Points2 star_polygon(int points, double outer_m, double inner_m);
/// A gear: each tooth fills half a pitch at the root circle and `tip_share` of it at the tip circle; arcs in short
/// chords.
Points2 gear_polygon(int teeth, double root_m, double tip_m, double tip_share);

/// Signed distance to bars of `width` at distance `pitch`, perpendicular to the u axis, one of them through the origin:
/// w/2 − |u − nearest multiple of the pitch|. Concentric rings are bars over the radius.
double bars_distance(double u, double pitch_m, double width_m);
/// Signed distance to the squares of a chessboard, a raised one centred at the origin: distance to the nearest line of
/// the board.
double checker_distance(const Vector2& p, double square_m);
/// Signed distance to bricks in rows, each row shifted by half a brick; `gap` is the joint.
double bricks_distance(const Vector2& p, double length_m, double height_m, double gap_m);

/// Nearest point of the hexagonal lattice with this pitch, which contains the origin and (pitch, 0).
Vector2 nearest_hexagonal(const Vector2& p, double pitch_m);
/// Distance from p to the border of its cell in that lattice (hexagon of the nearest lattice point).
double hexagon_border_distance(const Vector2& p, double pitch_m);
/// Distance from p to the border of its Voronoi cell among one random point in each square of side `pitch`.
double cell_border_distance(const Vector2& p, double pitch_m, std::uint64_t seed);

}  // namespace tacipc
