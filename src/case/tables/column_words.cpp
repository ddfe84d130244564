#include "tables/column_words.hpp"

#include <map>

namespace railstrata {

const std::vector<std::string_view>& words_of(std::string_view key) {
  static const std::vector<std::string_view> none;
  static const std::map<std::string_view, std::vector<std::string_view>> words{
      {"file", {"Datei", "Fichier", "Fil", "文件"}},
      {"share", {"Anteil", "Part", "Andel", "比例"}},
      {"name", {"Name", "Fahrzeug", "Véhicule", "Fordon", "名称"}},
      {"passages", {"Überrollungen", "Überfahrten", "Anzahl", "Nombre", "Antal", "通过次数"}},
      {"mgt", {"MGT", "Mio. t", "总重"}},
      {"wheel_load", {"Q", "Radlast", "Charge par roue", "Hjullast", "轮重"}},
      {"axle_load", {"Radsatzlast", "Achslast", "Charge par essieu", "Axellast", "轴重"}},
      {"wheel_profile", {"Radprofil", "Profil de roue", "Hjulprofil", "车轮踏面"}},
      {"wheel_radius", {"Radradius", "Laufkreisradius", "Rayon de roue", "Hjulradie", "车轮半径"}},
      {"lateral_shift", {"y", "Querverschiebung", "Déplacement latéral", "Sidoförskjutning", "横移量"}},
      {"yaw", {"psi", "Anlaufwinkel", "Gierwinkel", "Angle d'attaque", "Anloppsvinkel", "冲角"}},
      {"roll", {"phi", "Wankwinkel", "Roulis", "Rollvinkel", "侧滚角"}},
      {"creepage", {"Längsschlupf", "Glissement longitudinal", "Längskryp", "纵向蠕滑率"}},
      {"lateral_creepage", {"Querschlupf", "Glissement latéral", "Tvärkryp", "横向蠕滑率"}},
      {"curve_radius",
       {"Bogenradius", "Bogenhalbmesser", "Kurvenradius", "Rayon de courbe", "Rayon", "Kurvradie", "曲线半径"}},
      {"guiding_force", {"Y", "Führungskraft", "Force de guidage", "Styrkraft", "导向力"}},
      {"t_gamma", {"T-gamma"}},
      {"speed", {"Geschwindigkeit", "Vitesse", "Hastighet", "速度"}},
      {"friction_coefficient",
       {"Reibwert", "Reibbeiwert", "Coefficient de frottement", "Friktionskoefficient", "摩擦系数"}},
      {"traction_coefficient", {"Kraftschluss", "Coefficient d'adhérence", "Adhesionskoefficient", "牵引系数"}},
      {"time", {"Zeit", "Temps", "Tid", "时间"}},
      {"distance", {"s", "Weg", "Distance", "Sträcka", "里程", "Kilometrierung", "Chainage"}},
      {"frequency", {"Frequenz", "fréquence", "frekvens", "频率"}},
      {"receptance", {"Rezeptanz", "réceptance", "receptans", "位移导纳"}},
      {"mobility", {"Admittanz", "mobilité", "mobilitet", "速度导纳"}},
      {"accelerance", {"Akzeleranz", "accélérance", "accelerans", "加速度导纳"}},
      {"phase", {"fas", "相位"}},
      {"wavelengths", {"wavelength", "Wellenlänge", "longueur d'onde", "Våglängd", "波长"}},
      {"levels", {"level", "Pegel", "niveau", "nivå", "粗糙度级"}},
      {"x", {"s", "Weg", "Distance", "Sträcka", "Chainage", "里程"}},
      {"z", {"Höhe", "Hauteur", "Höjd", "height", "高度"}}};
  const auto found = words.find(key);
  return found == words.end() ? none : found->second;
}

}  // namespace railstrata
