// What the first page says of every dataset: how it is made, frames and units, what its checks prove.
#pragma once

namespace tacipc {

inline constexpr const char* kLead =
    R"html(<p class="lead">Simulated touch for learning with camera-based tactile sensors. In each sample a rigid object moves into the soft gel of a sensor; a camera behind the gel sees how its painted front face deforms under coloured light. The gel is computed by finite elements that never pass through the object, the images are ray traced, and every force, displacement and slip that made an image is stored beside it.</p>
)html";

inline constexpr const char* kUnitsAndFrames = R"html(<section id="frames">
<h2>Units and frames</h2>
<div class="prose">
<p>All quantities are given in one frame, <b>S</b> (of the sensor). Its origin is the centre of the gel's front face before anything touches it. <b>x</b> points to the right of the image, <b>y</b> down in the image, <b>z</b> out of the gel, towards the object. The camera sits behind the gel, at negative z, and looks along +z through the gel at the inside of its front face. An object that presses in moves towards −z.</p>
</div>
<figure class="diagram"><svg viewBox="0 0 480 260" role="img" aria-label="Side view: camera below, gel above it, object on top; z points from the gel to the object, x to the right, y away from you">
<rect class="body" x="205" y="214" width="70" height="34" rx="6"/><text x="240" y="236" text-anchor="middle">camera</text>
<path class="ray" d="M240 214L120 108M240 214L360 108"/>
<rect class="gel" x="80" y="104" width="320" height="46" rx="4"/><text x="92" y="142">gel</text>
<text class="soft" x="408" y="108">front face,</text><text class="soft" x="408" y="124">z = 0</text>
<path class="body" d="M190 28h100v40l-50 30l-50-30z"/><text x="240" y="54" text-anchor="middle">object</text>
<path class="arrow" d="M240 104V66M234 74l6-9l6 9"/><text x="250" y="86">z</text>
<path class="arrow" d="M240 104H300M292 98l9 6l-9 6"/><text x="306" y="100">x</text>
<circle class="arrow" cx="240" cy="104" r="4"/><text class="soft" x="222" y="121" text-anchor="end">S</text>
<text class="soft" x="20" y="24">y points away from you</text>
</svg><figcaption>Seen from the side, not to scale. Image right is x; image down is y.</figcaption></figure>
<div class="scroll" role="region" tabindex="0" aria-label="Quantities with units and frames"><table>
<thead><tr><th class="word">What</th><th class="word">File of a sample</th><th class="word">Unit there</th><th class="word">In packed shards</th><th class="word">Frame and sign</th></tr></thead>
<tbody>
<tr><td class="word">tactile image</td><td class="word">render/frame_NNNN/tactile.png</td><td class="word">8-bit RGB</td><td class="word">rgb</td><td class="word">row 0 on top, smallest y</td></tr>
<tr><td class="word">the same with printed markers</td><td class="word">…/marker.png</td><td class="word">8-bit RGB</td><td class="word">rgb_marker</td><td class="word">as above</td></tr>
<tr><td class="word">indentation</td><td class="word">…/indentation.exr</td><td class="word">m</td><td class="word">mm</td><td class="word">&gt; 0 into the gel, of the gel point seen</td></tr>
<tr><td class="word">depth</td><td class="word">…/depth.exr</td><td class="word">m</td><td class="word">mm</td><td class="word">along the camera's axis, from the camera</td></tr>
<tr><td class="word">normal</td><td class="word">…/normal.exr</td><td class="word">1</td><td class="word">1</td><td class="word">S; outward, so a flat face has (0, 0, 1)</td></tr>
<tr><td class="word">traction</td><td class="word">…/traction.exr, press/traction.npy</td><td class="word">Pa</td><td class="word">N per cell</td><td class="word">S; on the gel by the object</td></tr>
<tr><td class="word">force and torque</td><td class="word">press/wrench.npy</td><td class="word">N, N m</td><td class="word">N, N mm</td><td class="word">S, about its origin; on the gel by the object</td></tr>
<tr><td class="word">press force</td><td class="word">press/press.yaml</td><td class="word">N</td><td class="word">N</td><td class="word">&gt; 0 into the gel (−z)</td></tr>
<tr><td class="word">pose of the object</td><td class="word">press/object_pose.npy</td><td class="word">m</td><td class="word">mm, quaternion x y z w</td><td class="word">from the object's frame to S</td></tr>
<tr><td class="word">markers</td><td class="word">press/markers.npy, …/marker_px.npy</td><td class="word">m, px</td><td class="word">mm, px</td><td class="word">S; pixel (0, 0) spans 0 … 1</td></tr>
<tr><td class="word">stick and slip</td><td class="word">press/contact_state.npy</td><td class="word">0, 1, 2</td><td class="word">codes</td><td class="word">no contact, sticks, slips</td></tr>
</tbody></table></div>
<p>Lengths in a sample's own files are metres; packed shards have millimetres, newtons and newton millimetres, and each field there says its unit, frame and sign itself. Frame 0 of a sample is the gel before contact.</p>
</section>
)html";

inline constexpr const char* kTrust = R"html(<div class="prose">
<p>A sample counts as made only if <b>every</b> frame of it passed the checks in the table; a frame that missed one makes the whole sample a failed one, which is in no shard. These pages judge the numbers in the records again.</p>
<ul>
<li><b>What a passed sample proves:</b> the equations were solved. Newton's method converged in every step; exact arithmetic, which shares nothing with the solver, found no intersecting triangles and no inverted element; contact forces balance the force on the gel's glued back.</li>
<li><b>What it does not prove:</b> that gel, paint and lamps are those of the sensor on your desk. The gel is one homogeneous material without hysteresis, and without viscosity unless its sensor file has a relaxation; objects are rigid; friction is smoothed Coulomb friction, so that sticking contacts creep a little.</li>
<li><b>Distance at contact:</b> a barrier keeps the surfaces apart, by 5 to 9 µm at smooth parts with the default settings, so contact begins that much early.</li>
<li><b>Mesh:</b> finer gel meshes still change forces by a few percent. The name of a gel ends with that of its mesh.</li>
<li><b>Light:</b> values of a sensor file are marked known, derived or guess. Guessed lamps give plausible images, not calibrated ones; <em>image noise</em> above says whether a photograph of the real sensor was used.</li>
<li><b>Splits:</b> <em>split</em> is by object: no object of test is in train. <em>Pose split</em> is by pose, for questions about new poses of known objects.</li>
</ul>
</div>
)html";

}  // namespace tacipc
