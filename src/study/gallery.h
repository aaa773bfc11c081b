/// The pictures of the report (HTML).
#pragma once

#include "study/analysis.h"
#include "study/stored_pictures.h"

namespace tyndall::study {

class Gallery {
  public:
    Gallery(const Results& results, const Reference& reference, const StoredPictures& stored);

    /// The whole picture, as the reference has it.
    std::string reference() const;
    /// The same detail of each technique, after the same time.
    std::string equal_time(const std::vector<const TechniqueResult*>& techniques) const;
    /// Mean of all runs less the reference, with a scale.
    std::string errors(const std::vector<const TechniqueResult*>& techniques) const;

  private:
    std::string figure(const Image& image, const std::string& name, const std::string& alt,
                       const std::string& caption) const;

    const Results& results_;
    const StoredPictures& stored_;
    Canvas reference_;
    double exposure_;
    Crop detail_;
};

} // namespace tyndall::study
