// caught by: hamiltonian, other-regulators
// mistake: small steps along the bracket, as in iterated(): far too few of them for a stiff plant.

// <solution viaHamiltonian>
return iterated(plant, costs, 1e-3, 1e-9, 1000000).value_or(costs.Q);
// </solution>
