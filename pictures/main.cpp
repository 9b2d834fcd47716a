#include <CLI/CLI.hpp>
#include <iostream>

#include "common/base/error.hpp"
#include "pictures/display_server.hpp"
#include "pictures/scene.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Draws a mesh coloured by a field, from two sides, into a PNG file. Needs Xvfb, not a screen.",
               "tether_picture"};
  tether::Scene scene;
  std::filesystem::path png;
  std::vector<double> range;
  app.add_option("MESH", scene.mesh, ".vtu or .vtp file")->required();
  app.add_option("PNG", png, "picture to write")->required();
  app.add_option("--field", scene.field, "field of points or cells; of vectors the magnitude is shown")->required();
  app.add_option("--title", scene.title, "text above the colours");
  app.add_option("--factor", scene.factor, "multiplies the field");
  app.add_option("--range", range, "smallest and largest value of the colours")->expected(2);
  app.add_option("--names", scene.names, "of the values 0, 1, 2 ... of the field");
  app.add_flag("--diverging", scene.diverging, "colours around zero");
  app.add_option("--warp", scene.warp, "field of points that displaces the mesh");
  app.add_option("--warp-scale", scene.warp_scale, "exaggeration of the displacement");
  app.add_flag("--cut", scene.cut, "take away the half that faces the viewer");
  app.add_option("--lines", scene.lines, ".vtp file with lines to draw over the mesh");
  app.add_option("--width", scene.width, "pixels");
  app.add_option("--height", scene.height, "pixels");
  CLI11_PARSE(app, argc, argv);
  if (!range.empty()) scene.range = {range[0], range[1]};
  try {
    const tether::DisplayServer display;
    tether::draw(scene, png);
  } catch (const std::exception& error) {
    std::cerr << "tether_picture: " << error.what() << "\n";
    return 1;
  }
}
