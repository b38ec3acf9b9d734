"""What a least-squares solver is given instead of the residuals of a fit, so that it has less to do."""
