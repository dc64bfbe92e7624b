// caught by: rays
// mistake: rounds to the nearest corner of a cell.

// <solution cellAt>
return {static_cast<int>(std::round((p.x() - grid.origin.x()) / grid.cell)),
        static_cast<int>(std::round((p.y() - grid.origin.y()) / grid.cell))};
// </solution>
